// SPDX-License-Identifier: GPL-3.0-or-later
// Markdown of lessons as elements. HTML stays text, links lead only to http and https, and pictures are not
// loaded.

import { lexer, type Token, type Tokens } from 'marked';
import { h } from './dom';

export function markdown(text: string): DocumentFragment {
  const fragment = document.createDocumentFragment();
  for (const token of lexer(text)) fragment.append(block(token));
  return fragment;
}

/** One line of Markdown. */
export function calledOut(name: string, text: string): HTMLElement {
  const [token] = lexer(text);
  return h('p', { className: 'called' }, h('b', {}, name), token?.type === 'paragraph' ? inline(token.tokens) : text);
}

function block(token: Token): Node {
  switch (token.type) {
    case 'heading':
      return h(token.depth <= 1 ? 'h3' : 'h4', {}, inline(token.tokens));
    case 'paragraph': {
      const called = /^(Question|Predict|Prediction|Check|Hint):\s*/.exec(token.text as string);
      return called
        ? calledOut(called[1], (token.text as string).slice(called[0].length))
        : h('p', {}, inline(token.tokens));
    }
    case 'code':
      return h('pre', { className: 'sample', tabIndex: 0 }, h('code', {}, token.text as string));
    case 'blockquote':
      return h('blockquote', {}, blocks(token.tokens));
    case 'hr':
      return h('hr');
    case 'space':
    case 'def':
      return document.createTextNode('');
    case 'list': {
      const list = token as Tokens.List;
      const items = list.items.map((item) => h('li', {}, blocks(item.tokens)));
      return list.ordered ? h('ol', { start: Number(list.start) || 1 }, ...items) : h('ul', {}, ...items);
    }
    case 'table': {
      const table = token as Tokens.Table;
      return h(
        'div',
        { className: 'scroll', tabIndex: 0, role: 'region', 'aria-label': 'Table' },
        h(
          'table',
          {},
          h('thead', {}, h('tr', {}, ...table.header.map((c) => h('th', {}, inline(c.tokens))))),
          h('tbody', {}, ...table.rows.map((row) => h('tr', {}, ...row.map((c) => h('td', {}, inline(c.tokens)))))),
        ),
      );
    }
    case 'text':
      return inline((token as Tokens.Text).tokens ?? [token]);
    default:
      return h('p', {}, token.raw);
  }
}

function blocks(tokens: Token[] | undefined): DocumentFragment {
  const fragment = document.createDocumentFragment();
  for (const token of tokens ?? []) fragment.append(block(token));
  return fragment;
}

function inline(tokens: Token[] | undefined): DocumentFragment {
  const fragment = document.createDocumentFragment();
  for (const token of tokens ?? []) {
    switch (token.type) {
      case 'strong':
        fragment.append(h('strong', {}, inline(token.tokens)));
        break;
      case 'em':
        fragment.append(h('em', {}, inline(token.tokens)));
        break;
      case 'del':
        fragment.append(h('del', {}, inline(token.tokens)));
        break;
      case 'codespan':
        fragment.append(h('code', {}, token.text as string));
        break;
      case 'br':
        fragment.append(h('br'));
        break;
      case 'link':
        fragment.append(
          /^https?:\/\//i.test(token.href as string)
            ? h('a', { href: token.href, target: '_blank', rel: 'noopener noreferrer' }, inline(token.tokens))
            : inline(token.tokens),
        );
        break;
      case 'image':
        fragment.append((token.text as string) || '');
        break;
      case 'escape':
        fragment.append(token.text as string);
        break;
      case 'text':
        fragment.append((token as Tokens.Text).tokens ? inline((token as Tokens.Text).tokens) : token.raw);
        break;
      default:
        fragment.append(token.raw);
    }
  }
  return fragment;
}
