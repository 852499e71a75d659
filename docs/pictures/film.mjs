// Takes pictures of a replay in Chromium. Reads {file, address, width, height, scale, times, directory} from standard
// input, and writes DIRECTORY/0000.png and so on, one for each time in seconds. A time of null is
// that of the address.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const { chromium } = createRequire(new URL("../../viewer/package.json", import.meta.url))("playwright-core");
const asked = JSON.parse(readFileSync(0, "utf8"));
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--headless=new", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"],
});
const page = await browser.newPage({
  viewport: { width: asked.width, height: asked.height },
  deviceScaleFactor: asked.scale,
});
await page.goto(`file://${asked.file}${asked.address}`);
await page.evaluate(() => gradysim.ready);
for (const [number, time] of asked.times.entries()) {
  if (time !== null) await page.evaluate((seconds) => gradysim.seek(seconds), time);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.screenshot({ path: `${asked.directory}/${String(number).padStart(4, "0")}.png` });
}
await browser.close();
