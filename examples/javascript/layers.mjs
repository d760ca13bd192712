// Asks a server for the layers of a recipe: lamella serve --http.
// Usage: node layers.mjs ADDRESS TOKEN RECIPE. Prints the contours and the area of every tenth layer.
import { readFile } from "node:fs/promises";

const [address, token, recipe] = process.argv.slice(2);

async function ask(path, body) {
    const reply = await fetch(address + path, {
        method: body ? "POST" : "GET",
        headers: { Authorization: `Bearer ${token}` },
        body: body && JSON.stringify(body),
    });
    const json = await reply.json();
    if (!reply.ok) throw new Error(json.message);
    return json;
}

const job = await ask("/api/jobs", { text: await readFile(recipe, "utf8") });
const { count } = job.layers;
console.log(`${job.name} on ${job.machine}: ${count} layers`);
for (let layer = 0; layer < count; layer += Math.max(1, Math.floor(count / 10))) {
    const { contours, area } = await ask(`/api/jobs/${job.job}/layers/${layer}/contours?tolerance=0.05`);
    console.log(`layer ${layer}: ${contours.length} contours, ${area.toFixed(2)} mm2`);
}
