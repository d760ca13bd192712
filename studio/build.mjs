// Bundles the page into dist/: index.html, studio.js, studio.css and icon.svg. `--watch` rebuilds on changes.
import { copyFileSync, mkdirSync, rmSync, statSync } from "node:fs";
import { build, context } from "esbuild";

const options = {
    entryPoints: { studio: "src/main.tsx" },
    bundle: true,
    minify: true,
    outdir: "dist",
    format: "esm",
    target: ["es2022"],
    jsx: "automatic",
    jsxImportSource: "preact",
    legalComments: "eof",
    loader: { ".glsl": "text" },
    logLevel: "warning",
};

rmSync("dist", { recursive: true, force: true });
mkdirSync("dist");
for (const file of ["index.html", "icon.svg"]) copyFileSync(`src/${file}`, `dist/${file}`);

if (process.argv.includes("--watch")) {
    await (await context(options)).watch();
} else {
    await build(options);
    for (const file of ["studio.js", "studio.css"]) {
        console.log(`dist/${file}  ${Math.round(statSync(`dist/${file}`).size / 1024)} KiB`);
    }
}
