#!/usr/bin/env python3
"""Measures what GL draws on a GPU, beside what the program draws itself there, and writes tests/bench/GPU.md.

    tests/bench/gpu.py [PROGRAMS]       measures with build/release, or with isochron and isochron_bench in this folder
    tests/bench/gpu.py --page           writes the page from what was last measured

What was measured stays in build/gpu. Where there is no GPU it measures nothing.
"""
import datetime
import json
import pathlib
import sys

import trade
from pages import ROOT, commit, processor, said, table

KEPT, PAGE = ROOT / "build/gpu", "tests/bench/GPU.md"


def measure(programs):
    bench = programs[0] if programs else ROOT / "build/release/tests/bench"
    isochron = pathlib.Path(programs[0] if programs else ROOT / "build/release/app") / "isochron"
    KEPT.mkdir(parents=True, exist_ok=True)
    (KEPT / "about.json").write_text(json.dumps(
        {"commit": commit(PAGE), "date": datetime.date.today().isoformat(), "machine": processor()}))
    (KEPT / "bench.json").write_text(said(pathlib.Path(bench) / "isochron_bench", "--benchmark_filter=^(gl|BM_EyePair)",
                                          "--benchmark_format=json"))
    for name, (file, _, options, _) in trade.SCENES.items():
        if (trade.DATA / file).exists():
            for by in ("gl", "cpu"):
                (KEPT / f"{name}.{by}.json").write_text(said(
                    isochron, "measure", trade.DATA / file, *options, "--opacity-per", "length", "--splatter", by,
                    "--device", "gpu",
                    "--size", "600x600", "--modes", "points,cells,lit cells", "--json"))
    # A window needs GLX of the GPU's driver on the X server that this starts.
    window = pathlib.Path(programs[0] if programs else ROOT / "build/release/tests/ui") / "ui_bench"
    if window.exists():
        (KEPT / "window.txt").write_text(said(window))


def kept(name):
    file = KEPT / f"{name}.json"
    return json.loads(file.read_text()) if file.exists() else None


def figures(bench, name):
    for f in bench:
        if f["run_type"] == "iteration" and f["name"].startswith(name + "/") and "error_occurred" not in f:
            arguments = dict(part.split(":") for part in f["name"].split("/")[1:] if ":" in part)
            yield {key: int(value) for key, value in arguments.items() if value.isdigit()}, f


def ms(value):
    return trade.time(1e-3 * value)


WHAT = ["one colour", "by value, mixed", "by value, in order"]


def beside(bench, name, told):
    return [[*told(a, f), ms(f["first_ms"]), ms(f["second_ms"]), f"{f['second/first']:.2f}"] for a, f in figures(bench, name)]


def frames(bench):
    rows = beside(bench, "glPoints", lambda a, f: [f"{a['splats']:,} points of {a['diameter']} pixels, {WHAT[a['what']]}"])
    rows += beside(bench, "glMeshPoints", lambda a, f: [f"{a['splats']:,} points of a mesh, {WHAT[a['what']]}"])
    grid = lambda a: f"{a['points']}³ of turbulence" if a["points"] else "the pool fire, 600 to 1000 K"
    rows += beside(bench, "glCells", lambda a, f: [
        f"{f['cells']:,.0f} cells, {grid(a)}, {'lit, by value, in order' if a['lit'] else 'one colour'}"])
    rows += beside(bench, "glCellsSwept", lambda a, f: [f"{f['cells']:,.0f} cells, {grid(a)}, the same, swept"])
    rows += beside(bench, "glCellsOfMesh", lambda a, f: [
        f"{f['cells']:,.0f} cells, {grid(a)}, {'hexahedra' if a['hexahedra'] else 'curvilinear'}, {'in order' if a['ordered'] else 'unordered'}"])
    return table(["1024 x 1024", "GL", "program", "program / GL"], rows)


def scenes():
    rows = []
    for name, (_, title, _, _) in trade.SCENES.items():
        by = [kept(f"{name}.{who}") for who in ("gl", "cpu")]
        if None in by:
            continue
        for mode in ("points", "cells", "lit cells"):
            gl, cpu = (next((m for m in d["modes"] if m["mode"] == mode), None) for d in by)
            if gl is None:
                continue
            rows.append([title if mode == "points" else "", mode, f"{gl['drawn']:,.0f}", f"{gl['depthError']:.3f}", trade.mass(gl),
                         trade.in_float(gl), trade.time(gl["frame"]), f"{cpu['depthError']:.3f}", trade.in_float(cpu),
                         trade.time(cpu["frame"]), f"{cpu['frame'] / gl['frame']:.2f}"])
    return table(["600 x 600", "mode", "drawn", "GL: error", "mass", "in float", "frame", "program: error", "in float", "frame", "program / GL"], rows)


def window():
    file = KEPT / "window.txt"
    if not file.exists():
        return ""
    return f"""
The window (`ui_bench`) on an X server without a GPU of its own, its frames drawn by this one:

```
{file.read_text().rstrip()}
```
"""


def page():
    about, bench = kept("about"), kept("bench")
    if not about or not bench:
        sys.exit("nothing was measured yet")
    bench = bench["benchmarks"]
    label = next(f["label"] for f in bench if f.get("label"))
    threads = next(int(f["sharing"]) for f in bench if "sharing" in f)
    order = table(["points", "the GPU's own", "made by the program and sent", "ratio"], beside(bench, "glOrder", lambda a, f: [f"{a['splats']:,}"]))
    eyes = table(["splats", "an eye", "one", "a pair", "pair / one"],
                 [[f"{a['splats']:,}", f"{a['width']} x {a['height']}", ms(f["first_ms"]), ms(f["second_ms"]), f"{f['second/first']:.2f}"]
                  for a, f in figures(bench, "BM_EyePair")])
    foretold = [f for _, f in figures(bench, "glForetoldFrame")]
    (ROOT / PAGE).write_text(f"""# On a GPU

`tests/bench/gpu.py` makes this page. {label}; the program beside it on {about['machine']}, {threads} threads. *Commit {about['commit']}, {about['date']}.*
Medians of frames drawn by turns, finished when they are counted, without axes and legend. What they mean: "On an H100" in [NOTES.md](NOTES.md).

{frames(bench)}
A draw list in order of depth, which a frame makes once for all eyes:

{order}
Frames foretold from others of the same field, of other ranges and views: {min(f['within25'] for f in foretold):.2f} to {max(f['within25'] for f in foretold):.2f} of them
within 25 % of the median of 50 (eight kinds of scenes; the worst off by {max(max(f['worst'], 1 / f['worst']) for f in foretold):.2f}).

A headset's eyes, one colour:

{eyes}
The scenes of [TRADE.md](TRADE.md), by depth where they have more than one colour, against the same truth. What GL and the program draw
differs in float alone:

{scenes()}{window()}""")


if __name__ == "__main__":
    if "--page" not in sys.argv:
        measure(sys.argv[1:])
    page()
