// Opens a replay in Debian's Chromium and says what it shows. Reads one JSON object from standard input:
// {file, address, width, height, scale, dark, times, seeks, keys, fill, until, values, picture, screenshot, color,
// within}, or
// {url} for a page with two replays. `values` are expressions.
// `within` is how far a pixel's color may be from `color`, summed over red, green and blue (default 40).
// With `picture`, `screenshot` or `color` it draws the page, which takes seconds.
// With `is_broken`, the page shows no run, but the text `until`.
// `url` instead of `file`, the time `after` which to look, `pause`, and `kill`, [pid, signal], are for a run that goes on.
// Writes one object to standard output.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const { chromium } = createRequire(new URL("../../viewer/package.json", import.meta.url))("playwright-core");
const asked = JSON.parse(readFileSync(0, "utf8"));

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--headless=new", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"],
});
const context = await browser.newContext({
  viewport: { width: asked.width ?? 1280, height: asked.height ?? 800 },
  deviceScaleFactor: asked.scale ?? 1,
  colorScheme: asked.dark ? "dark" : "light",
});
const said = { console: [], requests: [] };
const page = await context.newPage();
page.on("console", (message) => said.console.push(`${message.type()}: ${message.text()}`));
page.on("pageerror", (error) => said.console.push(`error: ${error.message}`));
page.on("request", (request) => {
  if (request.isNavigationRequest() || request.url().startsWith("data:")) return;
  said.requests.push(request.url());
});

const opened = performance.now();
await page.goto(asked.url ?? `file://${asked.file}${asked.address ?? ""}`);
if (asked.is_broken) await shows(asked.until);
else await look();
await browser.close();
process.stdout.write(JSON.stringify(said));

async function look() {
  await page.waitForFunction(() => window.gradysim); // of a run that goes on, it comes with the run
  await page.evaluate(() => gradysim.ready);
  said.open_s = (performance.now() - opened) / 1000;
  await page.waitForFunction((time) => document.querySelector("input.time").value >= time, asked.after ?? 0);
  if (asked.pause) await pause();
  said.states = await page.evaluate(async (times) => {
    const states = [];
    for (const time of times) states.push(await gradysim.state(time));
    return states;
  }, asked.times ?? []);
  said.seek_s = await page.evaluate(async (times) => {
    const took = [];
    for (const time of times) {
      const start = performance.now();
      await gradysim.seek(time);
      took.push((performance.now() - start) / 1000);
    }
    return took;
  }, asked.seeks ?? []);
  if (asked.fill) await page.getByRole("combobox", { name: "Filter of frames" }).fill(asked.fill);
  for (const key of asked.keys ?? []) await act(key);
  if (asked.kill) process.kill(...asked.kill);
  if (asked.until) await shows(asked.until);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  said.address = decodeURIComponent(await page.evaluate(() => location.hash));
  said.text = await page.evaluate(() => document.body.innerText);
  said.values = {};
  for (const [name, code] of Object.entries(asked.values ?? {})) said.values[name] = await page.evaluate(code);
  said.scrolls_sideways = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  if (asked.picture || asked.screenshot || asked.color) await draw();
}

async function draw() {
  said.picture = (await page.locator("canvas.scene").screenshot()).toString("base64");
  const picture = await page.screenshot(asked.screenshot ? { path: asked.screenshot } : {});
  Object.assign(said, await page.evaluate(countColors, [picture.toString("base64"), asked.color ?? [0, 0, 0], asked.within ?? 40]));
}

/**
 * Press a key, or `{click: selector}`, `{choose: name of a node}`, `{until: text}`, `{wheel: selector, by}`,
 * `{drag: selector, by}` in pixels to the right, from the middle of an element, `{run: code}`, `{save: key, as: file}`.
 */
async function act(key) {
  if (key.click) await page.locator(key.click).click();
  else if (key.choose) await page.getByRole("combobox", { name: "Node" }).selectOption(key.choose);
  else if (key.until) await shows(key.until);
  else if (key.wheel || key.drag) await turnOrDrag(key);
  else if (key.run) await page.evaluate(key.run);
  else if (key.save) await save(key);
  else await page.keyboard.press(key);
}

async function turnOrDrag({ wheel, drag, by }) {
  const { x, y, width, height } = await page.locator(wheel ?? drag).boundingBox();
  const [left, top] = [x + width / 2, y + height / 2];
  await page.mouse.move(left, top);
  if (wheel) return page.mouse.wheel(0, by);
  await page.mouse.down();
  await page.mouse.move(left + by, top, { steps: 3 });
  await page.mouse.up();
}

/** Wait until the page or its address has a text. */
async function shows(text) {
  await page.waitForFunction(
    (wanted) => decodeURIComponent(location.hash).includes(wanted) || document.body.innerText.includes(wanted),
    text,
  );
}

/** Pause, wait until the time stands still, note the state then, and play again. */
async function pause() {
  await page.keyboard.press(" ");
  await page.waitForFunction(() => document.querySelector("button.main").textContent === "Play");
  const stands = () => {
    const time = document.querySelector("input.time").value;
    const before = window.timeBefore;
    window.timeBefore = time;
    return time === before && Number(time);
  };
  const time = await (await page.waitForFunction(stands, null, { polling: 1000 })).jsonValue();
  said.paused = await page.evaluate((seconds) => gradysim.state(seconds), time);
  await page.keyboard.press(" ");
  await page.waitForFunction((before) => document.querySelector("input.time").value > before, time);
}

/** Save what a key lets the page download; of a film, what it shows in the end. */
async function save({ save: key, as }) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press(key)]);
  await download.saveAs(as);
  if (!as.endsWith(".webm")) return;
  const player = await context.newPage();
  said.film = await player.evaluate(async (base64) => {
    const video = Object.assign(document.createElement("video"), { src: `data:video/webm;base64,${base64}`, muted: true });
    const happens = (name) => new Promise((done, fail) => {
      video.addEventListener(name, done, { once: true });
      video.addEventListener("error", () => fail(video.error), { once: true });
    });
    await happens("loadeddata");
    video.currentTime = 1e9; // the end of a file that does not say how long it is
    await happens("seeked");
    const canvas = Object.assign(document.createElement("canvas"), { width: video.videoWidth, height: video.videoHeight });
    canvas.getContext("2d").drawImage(video, 0, 0);
    return { duration_s: video.duration, end: canvas.toDataURL() };
  }, readFileSync(as).toString("base64"));
}

/** How many colors a picture has, and how many pixels of it are near one color. */
async function countColors([base64, [red, green, blue], within]) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
  const { data } = (() => {
    const canvas = new OffscreenCanvas(image.width, image.height);
    const drawing = canvas.getContext("2d");
    drawing.drawImage(image, 0, 0);
    return drawing.getImageData(0, 0, image.width, image.height);
  })();
  const colors = new Set();
  let near = 0;
  for (let at = 0; at < data.length; at += 4) {
    colors.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
    const off = Math.abs(data[at] - red) + Math.abs(data[at + 1] - green) + Math.abs(data[at + 2] - blue);
    if (off < within) near += 1;
  }
  return { colors: colors.size, near_pixels: near };
}
