// Opens report pages in headless Chromium as a reader would, and says what goes wrong: errors on the console, requests, tables that do
// not sort, views in space that stay empty, pages wider than a narrow screen. Leaves pictures beside each page.
// usage: node report.mjs CHROMIUM PAGE…; PAGE#N says that N ribs are shown in space. Exit code 1 where something is wrong.
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [executablePath, ...pages] = process.argv.slice(2);
const wrong = [];
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});

// How much of the canvas is drawn on, and in how many colours.
const drawn = (canvas) => {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  const colours = new Set();
  let covered = 0;
  for (let at = 0; at < data.length; at += 4) {
    if (data[at + 3] === 0) continue;
    covered += 1;
    colours.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
  }
  return { share: (4 * covered) / data.length, colours: colours.size };
};

for (const given of pages) {
  const [path, ribs] = given.split("#");
  const url = pathToFileURL(path).href;
  const say = (text) => wrong.push(`${path}: ${text}`);
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
  const page = await context.newPage();
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && say(`console: ${message.text()}`));
  page.on("pageerror", (error) => say(`error: ${error.message}`));
  page.on("request", (request) => !request.url().startsWith("data:") && request.url() !== url && say(`request: ${request.url()}`));
  const begun = Date.now();
  await page.goto(url);
  const shot = (name) => page.screenshot({ path: path.replace(/\.html$/, `-${name}.png`), fullPage: name !== "large" && name !== "view" });

  if (ribs) {
    const root = page.locator(".view").first();
    await page.waitForSelector(".view[data-ready]", { state: "attached", timeout: 60_000 });
    console.log(`${path}: ${ribs} ribs in space after ${Date.now() - begun} ms`);
    const ready = await root.getAttribute("data-ready");
    if (ready !== ribs) say(`${ready} ribs in space instead of ${ribs}`);
    const canvas = root.locator("canvas");
    await canvas.scrollIntoViewIfNeeded();
    const seen = await canvas.evaluate(drawn);
    if (seen.share < 0.002 || seen.colours < 3) say(`the view is empty: ${JSON.stringify(seen)}`);
    await shot("view");
    // A row picks its rib; the view marks the row.
    const row = page.locator("tr[data-rib]").first();
    const name = await row.getAttribute("data-rib");
    await row.click();
    const told = await root.locator("output").textContent();
    if (!told.startsWith(`${name}:`)) say(`a click on the row of ${name} told: ${told}`);
    if ((await page.locator("tr.picked").count()) === 0) say("no row is marked");
    // Somewhere on the canvas there is a rib to be picked.
    const box = await canvas.boundingBox();
    let picked = "";
    for (let y = 0.5; y < 1.5 && picked === ""; y += 0.023) {
      for (let x = 0.5; x < 1.5 && picked === ""; x += 0.041) {
        await canvas.click({ position: { x: box.width * (x % 1), y: box.height * (y % 1) } });
        picked = await root.locator("output").textContent();
      }
    }
    if (picked === "") say("no click on the view picks a rib");
    const before = await canvas.evaluate((canvas) => canvas.toDataURL());
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 120, box.y + box.height / 2 + 40, { steps: 4 });
    await page.mouse.up();
    if (before === (await canvas.evaluate((canvas) => canvas.toDataURL()))) say("dragging does not turn the view");
    for (const scheme of ["limit", "section", "utilisation"]) await root.locator("select").selectOption(scheme);
    for (const way of ["top", "front", "side", "space"]) await root.locator(`button[data-way=${way}]`).click();
  }

  const title = page.locator("table.sortable th").first();
  if ((await title.count()) > 0) {
    await title.click();
    if ((await title.getAttribute("aria-sort")) !== "ascending") say("a click on a title does not sort");
  }
  const large = Number(ribs ?? 0) > 2000;
  await shot(large ? "large" : "wide");
  await page.emulateMedia({ colorScheme: "dark" });
  await shot(large ? "large" : "dark");
  // A sheet of A4 at 96 points per inch.
  await page.setViewportSize({ width: 794, height: 1123 });
  await page.emulateMedia({ colorScheme: "light", media: "print" });
  const printed = await page.evaluate(() => document.documentElement.scrollWidth);
  if (printed > 794) say(`the page is ${printed} wide on a sheet of 794`);
  if (!large) await shot("print");
  await page.emulateMedia({ media: "screen" });
  await page.setViewportSize({ width: 390, height: 800 });
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  if (width > 390) say(`the page is ${width} wide on a screen of 390`);
  if (!large) await shot("narrow");
  await context.close();
}
await browser.close();
wrong.forEach((line) => console.error(line));
process.exit(wrong.length > 0 ? 1 : 0);
