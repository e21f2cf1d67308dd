// Opens every page of the documentation's site (`mdbook build docs`) in headless Chromium, and says what goes wrong: errors on the console,
// requests that leave the site, links and pictures that lead nowhere, mathematics and tables that were not read, a search that finds nothing.
// usage: node site.mjs CHROMIUM FOLDER [PICTURES]. Exit code 1 where something is wrong.
import { existsSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [executablePath, given, pictures] = process.argv.slice(2);
const folder = resolve(given);
const pages = readdirSync(folder).filter((name) => name.endsWith(".html") && !["404.html", "print.html", "toc.html"].includes(name));
const wrong = [];
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--allow-file-access-from-files"] });
const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
const anchors = new Map(); // page → its ids
const links = []; // from, to

for (const name of pages) {
  const say = (text) => wrong.push(`${name}: ${text}`);
  const page = await context.newPage();
  page.on("console", (message) => message.type() === "error" && say(`console: ${message.text()}`));
  page.on("pageerror", (error) => say(`error: ${error.message}`));
  page.on("request", (request) => !/^(file|data|blob):/.test(request.url()) && say(`request: ${request.url()}`));
  page.on("requestfailed", (request) => say(`nothing at ${request.url()}`));
  await page.goto(pathToFileURL(join(folder, name)).href);
  const seen = await page.evaluate(() => ({
    ids: [...document.querySelectorAll("[id]")].map((element) => element.id),
    links: [...document.querySelectorAll("main a[href]")].map((link) => link.href),
    broken: [...document.querySelectorAll("main img")].filter((image) => image.complete && image.naturalWidth === 0).map((image) => image.src),
    // Bars and hashes at the beginning of a paragraph: a table or a heading that was read as text.
    unread: [...document.querySelectorAll("main p")].map((p) => p.innerText).filter((text) => /^(\|.*\||#{1,6} )/m.test(text) || /\$\$|\\\(|\\frac/.test(text)),
    wide: document.documentElement.scrollWidth > window.innerWidth + 1,
    words: document.querySelector("main").innerText.length,
  }));
  anchors.set(name, new Set(seen.ids));
  links.push(...seen.links.map((to) => [name, to]));
  for (const picture of seen.broken) say(`no picture ${picture}`);
  for (const text of seen.unread) say(`not read as it was meant: ${text.slice(0, 80)}`);
  if (seen.wide) say("wider than the window");
  if (seen.words < 200) say("hardly any text");
  if (pictures) await page.screenshot({ path: join(pictures, name.replace(/html$/, "png")) });
  await page.close();
}

for (const [from, to] of links) {
  if (!to.startsWith("file:")) continue;
  const url = new URL(to);
  const path = fileURLToPath(url.origin === "null" ? `file://${url.pathname}` : url);
  const name = path.startsWith(folder) ? path.slice(folder.length + 1) : undefined;
  if (name === undefined) wrong.push(`${from}: leads out of the site: ${to}`);
  else if (!existsSync(path)) wrong.push(`${from}: leads nowhere: ${to}`);
  else if (url.hash && anchors.has(name) && !anchors.get(name).has(decodeURIComponent(url.hash.slice(1)))) wrong.push(`${from}: no such part: ${to}`);
}

const page = await context.newPage();
await page.goto(pathToFileURL(join(folder, "tutorial.html")).href);
await page.keyboard.press("s");
await page.keyboard.type("root radius");
const found = page.locator("#mdbook-searchresults a, #searchresults a").first();
await found.waitFor({ timeout: 10_000 }).catch(() => wrong.push("the search finds nothing"));
if (pictures) await page.screenshot({ path: join(pictures, "search.png") });
await browser.close();
wrong.forEach((line) => console.error(line));
console.log(`${pages.length} pages, ${links.length} links, ${wrong.length} wrong`);
process.exit(wrong.length ? 1 : 0);
