// SPDX-License-Identifier: GPL-3.0-or-later
// Chromium and the stand-in for the server, for all tests of a file.

import { after, before } from 'node:test';
import * as on from './browser.mjs';
import { startMock } from './mock_server.mjs';

export let browser, mock;
before(async () => {
  browser = await on.openBrowser();
  mock = await startMock(on.pageFolder);
});
after(async () => {
  await browser?.close();
  await mock?.close();
});

export const visit = (options, act, server = mock) => on.visit(browser, server.url, options, act);
