// Bundles the page into dist/: index.html, studio.js, studio.css and icon.svg. `--watch` rebuilds on changes.
import { appendFileSync, copyFileSync, mkdirSync, readFileSync, rmSync, statSync } from "node:fs";
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
    legalComments: "none", // licences() has them all
    loader: { ".glsl": "text" },
    logLevel: "warning",
    metafile: true,
};

/** The licences of all packages in the bundle, as a comment. */
function licences({ inputs }) {
    const names = Object.keys(inputs).map((path) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1]);
    const packages = [...new Set(names.filter(Boolean))].sort();
    const text_of = (name) => readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim();
    const texts = packages.map((name) => `${name}\n\n${text_of(name)}`);
    return `/*!\n${texts.join("\n\n----\n\n").replaceAll("*/", "* /")}\n*/\n`;
}

rmSync("dist", { recursive: true, force: true });
mkdirSync("dist");
for (const file of ["index.html", "icon.svg"]) copyFileSync(`src/${file}`, `dist/${file}`);

if (process.argv.includes("--watch")) {
    await (await context(options)).watch();
} else {
    const { metafile } = await build(options);
    appendFileSync("dist/studio.js", licences(metafile));
    for (const file of ["studio.js", "studio.css"]) {
        console.log(`dist/${file}  ${Math.round(statSync(`dist/${file}`).size / 1024)} KiB`);
    }
}
