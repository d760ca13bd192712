"""Asks a server for the layers of a recipe: lamella serve --http.

Usage: layers.py ADDRESS TOKEN RECIPE. Prints the contours and the area of every tenth layer.
"""
import json
import sys
import urllib.request

address, token, recipe = sys.argv[1:]


def ask(path, body=None):
    request = urllib.request.Request(address + path, data=None if body is None else json.dumps(body).encode())
    request.add_header("Authorization", f"Bearer {token}")
    with urllib.request.urlopen(request) as reply:
        return json.load(reply)


with open(recipe, encoding="utf-8") as file:
    job = ask("/api/jobs", {"text": file.read()})
count = job["layers"]["count"]
print(f"{job['name']} on {job['machine']}: {count} layers")
for layer in range(0, count, max(1, count // 10)):
    section = ask(f"/api/jobs/{job['job']}/layers/{layer}/contours?tolerance=0.05")
    print(f"layer {layer}: {len(section['contours'])} contours, {section['area']:.2f} mm2")
