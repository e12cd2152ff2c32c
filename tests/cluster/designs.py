"""A library of designs made of the samples, every one of another size, and the manifest that builds them."""

import json
import os
import re

# Cheap and dear ones in turn, so that no share is much larger than another.
SAMPLES = ["castle", "butterfly", "bird", "stairs", "creature", "skyline", "birthday", "mountains", "dragon"]

OPTIONS = [
    (["svg", "pdf"], []),
    (["svg", "glb"], ["--profile", "lightburn"]),
    (["pdf", "json"], ["--sheet", "a3"]),
    (["svg", "dxf"], ["--kerf", "0.1"]),
]


def write_designs(samples, directory, count):
    """Writes `count` designs to directory/designs and their manifest, which it returns. No two are alike."""
    os.makedirs(f"{directory}/designs")
    texts = {}
    for name in SAMPLES:
        with open(f"{samples}/{name}.xml", encoding="utf-8") as file:
            texts[name] = file.read()
    manifest = f"{directory}/jobs.jsonl"
    with open(manifest, "w", encoding="utf-8") as jobs:
        for i in range(count):
            name = SAMPLES[i % len(SAMPLES)]
            factor = 1 - 0.25 * i / count
            text = re.sub(
                r'\b(x|y|width|height)="([-0-9.]+)"',
                lambda found: f'{found[1]}="{float(found[2]) * factor:.6f}"',  # pylint: disable=cell-var-from-loop
                texts[name],
            )
            design = f"{i:03}-{name}"
            with open(f"{directory}/designs/{design}.xml", "w", encoding="utf-8") as file:
                file.write(text)
            formats, options = OPTIONS[i % len(OPTIONS)]
            job = {
                "input": f"designs/{design}.xml",
                "output": [f"out/{name}/{design}.{suffix}" for suffix in formats],
            }
            if options:
                job["options"] = options
            if i % 50 == 49:
                job["copies"] = 2
            jobs.write(json.dumps(job) + "\n")
    return manifest


def outputs(manifest, of=slice(None)):
    """The outputs that the manifest names, or those of some of its jobs."""
    with open(manifest, encoding="utf-8") as jobs:
        return {name for line in jobs.readlines()[of] for name in json.loads(line)["output"]}


def tree(directory):
    """What lies below the directory, as {path: bytes}."""
    found = {}
    for folder, _, names in os.walk(directory):
        for name in names:
            path = os.path.join(folder, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, directory)] = file.read()
    return found
