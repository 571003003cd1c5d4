// SPDX-License-Identifier: GPL-3.0-or-later
// The editor: CodeMirror for Lua, completion from the server, and error marks of the dry run and the last
// run. In a shadow root, CodeMirror adopts style sheets instead of <style> elements, which the content policy
// forbids. Colours are CSS custom properties.

import {
  autocompletion,
  closeBrackets,
  closeBracketsKeymap,
  completionKeymap,
  completionStatus,
} from '@codemirror/autocomplete';
import type { Completion, CompletionContext, CompletionResult } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap, indentWithTab } from '@codemirror/commands';
import {
  bracketMatching,
  HighlightStyle,
  indentOnInput,
  indentUnit,
  StreamLanguage,
  syntaxHighlighting,
} from '@codemirror/language';
import { lua } from '@codemirror/legacy-modes/mode/lua';
import { lintGutter, lintKeymap, setDiagnostics, type Diagnostic } from '@codemirror/lint';
import { highlightSelectionMatches, searchKeymap, searchPanelOpen } from '@codemirror/search';
import { EditorState, RangeSetBuilder, type Text, type Transaction } from '@codemirror/state';
import {
  Decoration,
  drawSelection,
  dropCursor,
  EditorView,
  highlightActiveLine,
  highlightActiveLineGutter,
  keymap,
  lineNumbers,
} from '@codemirror/view';
import { tags } from '@lezer/highlight';
import type { Api, Check, Mark } from './api';
import { h } from './dom';

const look = EditorView.theme({
  '&': { height: '100%', color: 'var(--ink)', backgroundColor: 'var(--paper)', fontSize: 'var(--code-size)' },
  '&.cm-focused': { outline: 'none' }, // #editor shows the outline
  '.cm-scroller': { fontFamily: 'var(--code-font)', lineHeight: '1.5' },
  '.cm-content': { caretColor: 'var(--ink)', paddingBottom: '4em' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)', borderLeftWidth: '2px' },
  '.cm-gutters': { backgroundColor: 'var(--paper)', color: 'var(--muted)', border: 'none' },
  '.cm-lineNumbers .cm-gutterElement': { minWidth: '2ch', paddingRight: '6px' },
  '.cm-gutter-lint': { width: '1em' },
  '.cm-gutter-lint .cm-gutterElement': { padding: '0.25em 0 0 0' },
  '.cm-activeLine': { backgroundColor: 'var(--line)' },
  '.cm-activeLineGutter': { backgroundColor: 'var(--line)', color: 'var(--ink)' },
  '.cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground': {
    backgroundColor: 'var(--selection)',
  },
  '.cm-matchingBracket, &.cm-focused .cm-matchingBracket': {
    backgroundColor: 'var(--selection)',
    outline: '1px solid var(--muted)',
  },
  '.cm-tooltip': {
    backgroundColor: 'var(--raised)',
    color: 'var(--ink)',
    border: '1px solid var(--rule)',
    borderRadius: '4px',
  },
  '.cm-tooltip.cm-tooltip-autocomplete > ul': { fontFamily: 'var(--code-font)', maxHeight: '14em' },
  '.cm-tooltip.cm-tooltip-autocomplete > ul > li': { padding: '3px 8px' },
  '.cm-tooltip-autocomplete ul li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--on-accent)' },
  '.cm-completionDetail': { fontStyle: 'normal', opacity: '1', marginLeft: '1.2em' },
  '.cm-completionMatchedText': { textDecoration: 'none', fontWeight: '700' },
  '.cm-tooltip.cm-completionInfo': { padding: '8px 10px', fontFamily: 'var(--text-font)', maxWidth: '26em' },
  '.cm-diagnostic': { padding: '6px 10px', whiteSpace: 'pre-wrap', fontFamily: 'var(--text-font)' },
  '.cm-diagnostic-error': { borderLeft: '5px solid var(--error)' },
  '.cm-diagnostic-warning': { borderLeft: '5px solid var(--warning)' },
  '.cm-diagnostic-info': { borderLeft: '5px solid var(--accent)' },
  '.cm-panels': { backgroundColor: 'var(--raised)', color: 'var(--ink)', borderColor: 'var(--rule)' },
  '.cm-panel.cm-search': { fontSize: '16px', padding: '6px 8px' },
  '.cm-textfield, .cm-button': {
    fontSize: '15px',
    color: 'var(--ink)',
    backgroundColor: 'var(--paper)',
    backgroundImage: 'none',
    border: '1px solid var(--rule)',
  },
});

const colours = HighlightStyle.define([
  { tag: [tags.keyword, tags.controlKeyword], color: 'var(--code-keyword)' },
  { tag: [tags.string, tags.special(tags.string)], color: 'var(--code-string)' },
  { tag: [tags.number, tags.bool, tags.null, tags.atom], color: 'var(--code-number)' },
  { tag: tags.comment, color: 'var(--code-comment)', fontStyle: 'italic' },
  { tag: [tags.standard(tags.variableName), tags.function(tags.variableName)], color: 'var(--code-builtin)' },
]);

// Classes: the content policy forbids style attributes.
const deepest = 16;
const hangingLines = Array.from({ length: deepest + 1 }, (_, depth) => Decoration.line({ class: `hang-${depth}` }));
const hangingLook = EditorView.theme(
  Object.fromEntries(
    hangingLines.map((_, depth) => [
      `.cm-line.hang-${depth}`,
      { paddingLeft: `calc(${depth}ch + 6px)`, textIndent: `-${depth}ch` },
    ]),
  ),
);

/** Wrapped lines keep their indent. */
const hanging = EditorView.decorations.of((view) => {
  const builder = new RangeSetBuilder<Decoration>();
  for (const { from, to } of view.visibleRanges) {
    for (let at = from; at <= to; ) {
      const line = view.state.doc.lineAt(at);
      const indent = Math.min(deepest, /^ */.exec(line.text)![0].length + 2);
      builder.add(line.from, line.from, hangingLines[indent]);
      at = line.to + 1;
    }
  }
  return builder.finish();
});

/** When typing over a selection, Chromium would add style attributes, which the content policy refuses. */
const typingOver = EditorView.domEventHandlers({
  beforeinput(event, view) {
    const { data } = event;
    if (event.inputType !== 'insertText' || !data || view.state.selection.ranges.every((r) => r.empty)) return false;
    event.preventDefault();
    const { from, to } = view.state.selection.main;
    const typed = (): Transaction =>
      view.state.update(view.state.replaceSelection(data), { userEvent: 'input.type', scrollIntoView: true });
    if (!view.state.facet(EditorView.inputHandler).some((takes) => takes(view, from, to, data, typed)))
      view.dispatch(typed());
    return true;
  },
});

export class Editor {
  readonly view: EditorView;
  private marks: Mark[] = [];
  private runMarks: Mark[] = [];
  private timer = 0;
  private checking: AbortController | undefined;
  private quiet = false;
  private within = -1; // of the editor's own scrolling

  constructor(
    host: HTMLElement,
    private readonly api: Api,
    private readonly on: {
      changed: (text: string) => void;
      checked: (marks: Mark[]) => void;
      found: (script: string, answer: Check) => void;
      failed: (error: unknown) => void;
    },
  ) {
    const root = host.attachShadow({ mode: 'open' });
    const frame = h('div');
    frame.style.height = '100%';
    root.append(frame);
    this.view = new EditorView({ root, parent: frame, state: this.state('') });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  /** Another document: new history, no marks. */
  open(text: string): void {
    this.runMarks = [];
    this.marks = [];
    this.quiet = true;
    this.view.setState(this.state(text));
    this.quiet = false;
    this.checkSoon(0);
  }

  /** Undoable; changes the differing part only, so that cursor and scroll position stay. */
  replace(text: string): void {
    const old = this.text;
    const most = Math.min(old.length, text.length);
    let same = 0;
    while (same < most && old[same] === text[same]) ++same;
    let behind = 0;
    while (behind < most - same && old[old.length - 1 - behind] === text[text.length - 1 - behind]) ++behind;
    this.view.dispatch({
      changes: { from: same, to: old.length - behind, insert: text.slice(same, text.length - behind) },
    });
  }

  focus(): void {
    this.view.focus();
  }

  goTo(line: number, column = 1): void {
    const at = this.view.state.doc.line(Math.min(Math.max(1, line), this.view.state.doc.lines));
    const anchor = Math.min(at.from + Math.max(0, column - 1), at.to);
    this.view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: 'center' }) });
    this.view.focus();
  }

  /** Moves neither the cursor nor the page. */
  showLine(line: number): void {
    const at = this.view.state.doc.line(Math.min(Math.max(1, line), this.view.state.doc.lines));
    this.within = at.from;
    this.view.dispatch({ effects: EditorView.scrollIntoView(at.from, { y: 'start' }) });
  }

  /** The marks stay until their text changes or another run starts. */
  showRunMarks(marks: Mark[]): void {
    this.runMarks = marks;
    this.draw();
  }

  /** Escape then closes something in the editor. */
  get wantsEscape(): boolean {
    return completionStatus(this.view.state) !== null || searchPanelOpen(this.view.state);
  }

  checkSoon(delay = 350): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.check(), delay);
  }

  private async check(): Promise<void> {
    this.checking?.abort();
    const mine = (this.checking = new AbortController());
    const doc = this.view.state.doc;
    if (!this.api.hasToken) return;
    try {
      const answer: Check = doc.length ? await this.api.check(doc.toString(), mine.signal) : { marks: [], knobs: {} };
      if (mine.signal.aborted || !this.view.state.doc.eq(doc)) return;
      this.marks = answer.marks;
      this.draw();
      this.on.found(doc.toString(), answer);
    } catch (error) {
      if (!mine.signal.aborted) this.on.failed(error);
    }
  }

  private draw(): void {
    const doc = this.view.state.doc;
    const all = [
      ...this.runMarks,
      ...this.marks.filter((m) => !this.runMarks.some((r) => r.line === m.line && r.message === m.message)),
    ];
    const diagnostics = all.map((m) => diagnostic(doc, m)).sort((a, b) => a.from - b.from);
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
    this.on.checked(all);
  }

  private state(doc: string): EditorState {
    return EditorState.create({
      doc,
      extensions: [
        lineNumbers(),
        lintGutter(),
        highlightActiveLineGutter(),
        history(),
        drawSelection(),
        dropCursor(),
        indentOnInput(),
        indentUnit.of('  '),
        bracketMatching(),
        closeBrackets(),
        highlightActiveLine(),
        highlightSelectionMatches(),
        EditorView.lineWrapping,
        EditorView.scrollHandler.of((_, { head }) => {
          // CodeMirror also scrolls the page: undo before the next paint.
          const { scrollX, scrollY } = window;
          if (head === this.within) queueMicrotask(() => scrollTo(scrollX, scrollY));
          this.within = -1;
          return false;
        }),
        hanging,
        hangingLook,
        typingOver,
        StreamLanguage.define(lua),
        syntaxHighlighting(colours),
        look,
        autocompletion({
          override: [(context) => this.complete(context)],
          icons: false,
          tooltipClass: () => 'asperity-completion',
        }),
        // The page handles Ctrl-Enter.
        keymap.of([{ key: 'Mod-Enter', run: () => true }]),
        keymap.of([
          ...closeBracketsKeymap,
          ...defaultKeymap,
          ...searchKeymap,
          ...historyKeymap,
          ...completionKeymap,
          ...lintKeymap,
          indentWithTab,
        ]),
        EditorView.contentAttributes.of({
          'aria-label': 'Script in Lua. Escape and then Tab leaves the editor.',
          tabindex: '0',
        }),
        EditorView.updateListener.of((update) => {
          if (!update.docChanged || this.quiet) return;
          this.runMarks = [];
          this.on.changed(this.text);
          this.checkSoon();
        }),
      ],
    });
  }

  private async complete(context: CompletionContext): Promise<CompletionResult | null> {
    // Only in a word or after a dot or colon: a list after a brace or comma would capture Enter.
    if (!context.explicit && !context.matchBefore(/[\w][.:]?$|[)\]"'}][.:]$/)) return null;
    const waiting = new AbortController();
    context.addEventListener('abort', () => waiting.abort());
    try {
      const answer = await this.api.complete(context.state.doc.toString(), context.pos, waiting.signal);
      if (answer.candidates.length === 0) return null;
      return {
        from: answer.from,
        validFor: /^\w*$/,
        options: answer.candidates.map(
          (c): Completion => ({
            label: c.text,
            type: c.kind,
            detail: c.detail,
            info: c.help ? () => h('div', c.help!) : undefined,
          }),
        ),
      };
    } catch (error) {
      if (!waiting.signal.aborted) this.on.failed(error);
      return null;
    }
  }
}

function diagnostic(doc: Text, mark: Mark): Diagnostic {
  const line = doc.line(Math.min(Math.max(1, mark.line), doc.lines));
  const indent = /^\s*/.exec(line.text)![0].length;
  const from = mark.column ? Math.min(line.from + mark.column - 1, line.to) : line.from + indent;
  return {
    from,
    to: Math.max(from, line.to),
    severity: mark.severity === 'note' ? 'info' : mark.severity,
    message: mark.hint ? `${mark.message}\n${mark.hint}` : mark.message,
  };
}
