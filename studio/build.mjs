// Bundles the page into dist/: index.html, studio.js, studio.css and icon.svg. `--watch` rebuilds on changes.
import { appendFileSync, copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { resolve } from "node:path";
import { build, context } from "esbuild";

const pictures = "src/start/pictures";

/** The module "gallery-pictures": all files of the folder by name. */
const gallery = {
    name: "gallery",
    setup({ onResolve, onLoad }) {
        onResolve({ filter: /^gallery-pictures$/ }, ({ path }) => ({ path, namespace: "gallery" }));
        onLoad({ filter: /.*/, namespace: "gallery" }, () => {
            const files = readdirSync(pictures).filter((file) => file.endsWith(".webp"));
            const lines = files.map((file, i) => `import p${i} from "./${file}";`);
            const table = files.map((file, i) => `${JSON.stringify(file.replace(".webp", ""))}: p${i}`);
            return {
                contents: `${lines.join("\n")}\nexport default { ${table.join(", ")} };`,
                resolveDir: resolve(pictures),
            };
        });
    },
};

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
    loader: { ".glsl": "text", ".webp": "dataurl" },
    plugins: [gallery],
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
