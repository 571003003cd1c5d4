// SPDX-License-Identifier: GPL-3.0-or-later
// Markdown of lessons as elements. HTML stays text, links lead only to http and https, pictures are not
// loaded.

import { lexer, type Token, type Tokens } from 'marked';
import { h, table } from './dom';

export function markdown(text: string): DocumentFragment {
  return blocks(lexer(text));
}

/** One line of Markdown. */
export function calledOut(name: string, text: string): HTMLElement {
  const [token] = lexer(text);
  return h('p.called', h('b', name), token?.type === 'paragraph' ? inline(token.tokens) : text);
}

function block(token: Token): Node | string {
  switch (token.type) {
    case 'heading':
      return h(token.depth <= 1 ? 'h3' : 'h4', {}, inline(token.tokens));
    case 'paragraph': {
      const called = /^(Question|Predict|Prediction|Check|Hint):\s*/.exec(token.text as string);
      return called
        ? calledOut(called[1], (token.text as string).slice(called[0].length))
        : h('p', inline(token.tokens));
    }
    case 'code':
      return h('pre.sample', { tabIndex: 0 }, h('code', token.text as string));
    case 'blockquote':
      return h('blockquote', blocks(token.tokens));
    case 'hr':
      return h('hr');
    case 'space':
    case 'def':
      return '';
    case 'list': {
      const { items, ordered, start } = token as Tokens.List;
      const made = items.map((item) => h('li', blocks(item.tokens)));
      return ordered ? h('ol', { start: Number(start) || 1 }, ...made) : h('ul', ...made);
    }
    case 'table': {
      const { header, rows } = token as Tokens.Table;
      const cells = (row: Tokens.TableCell[], tag: 'th' | 'td') => row.map((c) => h(tag, inline(c.tokens)));
      const made = table(cells(header, 'th'), rows.map((row) => cells(row, 'td')));
      return h('div.scroll', { tabIndex: 0, role: 'region', 'aria-label': 'Table' }, made);
    }
    case 'text':
      return inline((token as Tokens.Text).tokens ?? [token]);
    default:
      return h('p', token.raw);
  }
}

function blocks(tokens: Token[] | undefined): DocumentFragment {
  return gathered(tokens, block);
}

function inline(tokens: Token[] | undefined): DocumentFragment {
  return gathered(tokens, span);
}

function gathered(tokens: Token[] | undefined, made: (token: Token) => Node | string): DocumentFragment {
  const fragment = document.createDocumentFragment();
  fragment.append(...(tokens ?? []).map(made));
  return fragment;
}

function span(token: Token): Node | string {
  switch (token.type) {
    case 'strong':
    case 'em':
    case 'del':
      return h(token.type as 'strong' | 'em' | 'del', inline(token.tokens));
    case 'codespan':
      return h('code', token.text as string);
    case 'br':
      return h('br');
    case 'link':
      return /^https?:\/\//i.test(token.href as string)
        ? h('a', { href: token.href, target: '_blank', rel: 'noopener noreferrer' }, inline(token.tokens))
        : inline(token.tokens);
    case 'image':
    case 'escape':
      return token.text as string;
    default:
      return token.type === 'text' && token.tokens ? inline(token.tokens) : token.raw;
  }
}
