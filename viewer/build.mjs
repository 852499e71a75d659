// Builds python/gradysim/viewer/page.html: one file, with the script and the styles in it.
// `node build.mjs FILE` writes it to another place.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const target = process.argv[2] ?? `${here}../python/gradysim/viewer/page.html`;

const licenses = [];
for (const name of ["three", "uplot", "webm-muxer"])
  licenses.push(`${name}\n\n${await readFile(`${here}node_modules/${name}/LICENSE`, "utf8")}`);

const bundled = await build({
  absWorkingDir: here,
  entryPoints: ["src/main.ts"],
  bundle: true,
  minify: true,
  write: false,
  outdir: "out",
  format: "iife",
  target: ["chrome103", "firefox113", "safari16.4"],
  charset: "utf8",
  legalComments: "none",
  footer: { js: `/*\n${licenses.join("\n")}*/` }, // they ask for it
  loader: { ".css": "css" },
});
const text = (end) => bundled.outputFiles.find((file) => file.path.endsWith(end)).text;
const [style, script] = [".css", ".js"].map((end) => text(end).trim());
// The page runs its own script only, whatever a replay or the names of its nodes contain.
const hashOf = (content) => `'sha256-${createHash("sha256").update(content).digest("base64")}'`;
const page = (await readFile(`${here}src/page.html`, "utf8"))
  .replace("/* style hash */", () => hashOf(style))
  .replace("/* script hash */", () => hashOf(script))
  .replace("/* styles */", () => style)
  .replace("/* script */", () => script);
if (page.split("<!-- run -->").length !== 2) throw new Error("expected one place for the run in the page");
await writeFile(target, page);
