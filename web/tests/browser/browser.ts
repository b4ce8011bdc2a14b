// A real browser on the built page, which is served as static files.
import { readFile } from 'node:fs/promises';
import { createServer, type Server } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { type Browser, type Page, chromium } from 'playwright-core';
import { afterAll, beforeAll } from 'vitest';
import type { App } from '../../page/app';

export const folder = fileURLToPath(new URL('../../dist', import.meta.url));
export const program = process.env['PLIANT_CHROMIUM'] ?? '/usr/bin/chromium';

const types: Record<string, string> = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml',
  '.webp': 'image/webp',
};

/** The types of the files, and no other headers. */
async function serve(): Promise<{ server: Server; address: string }> {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url ?? '/', 'http://page').pathname));
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    readFile(file).then(
      (bytes) => response.writeHead(200, { 'Content-Type': types[extname(file)] ?? 'application/octet-stream' }).end(bytes),
      () => response.writeHead(404).end(),
    );
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address() as { port: number };
  return { server, address: `http://127.0.0.1:${port}/` };
}

function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: program,
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
           '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });
}

/** A browser and the address of the page, for all tests of a file. */
export function useBrowser(): { browser: Browser; address: string } {
  const used = {} as { browser: Browser; address: string };
  let server: Server | undefined;
  beforeAll(async () => {
    const served = await serve();
    server = served.server;
    used.address = served.address;
    used.browser = await launch();
  });
  afterAll(async () => {
    await used.browser?.close();
    server?.close();
  });
  return used;
}

declare global {
  var pliantPage: App;
}

export interface Tab {
  page: Page;
  /** What went wrong in its console. */
  errors: string[];
  /** Addresses that it asked for. */
  requests: string[];
  close(): Promise<void>;
}

export interface TabOptions {
  width?: number;
  height?: number;
  isPhone?: boolean;
  scheme?: 'light' | 'dark';
}

/** Opens the page, and waits for its first picture. */
export async function openTab(browser: Browser, address: string, options: TabOptions = {}): Promise<Tab> {
  const { width = 1280, height = 720, isPhone = false, scheme = 'light' } = options;
  const context = await browser.newContext({ viewport: { width, height }, hasTouch: isPhone, isMobile: isPhone,
                                             deviceScaleFactor: isPhone ? 2 : 1, colorScheme: scheme });
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  const page = await context.newPage();
  const errors: string[] = [];
  const requests: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error') errors.push(message.text());
  });
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('request', (request) => requests.push(request.url()));
  await page.goto(address);
  await page.waitForFunction(() => globalThis.pliantPage?.state.pictures > 1, null, { timeout: 30_000 });
  return { page, errors, requests, close: () => context.close() };
}

/** Waits until the page's state is so. */
export async function until(tab: Tab, condition: () => boolean, timeout = 15_000): Promise<void> {
  await tab.page.waitForFunction(condition, null, { timeout, polling: 50 });
}
