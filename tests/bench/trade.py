#!/usr/bin/env python3
"""Measures what each way of drawing costs and how true it is, on real data, and writes tests/bench/TRADE.md.

    tests/bench/trade.py                measures with build/release (some minutes), writes the page
    tests/bench/trade.py fire tooth     measures these scenes again; the others stay as last measured
    tests/bench/trade.py --page         writes the page from what was last measured

Data lie in ../shared/datasets, or in datasets below $ISOCHRON_SHARED; what is not there is left out.
What was measured stays in build/trade, its plots in tests/bench/trade. On a quiet machine only: what else runs is in the times.
"""
import datetime
import json
import os
import pathlib
import sys

from pages import ROOT, commit, processor, said, table

KEPT = ROOT / "build/trade"
PAGE, PLOTS = "tests/bench/TRADE.md", "tests/bench/trade"
PROGRAM = ROOT / "build/release/app/isochron"
DATA = pathlib.Path(os.environ.get("ISOCHRON_SHARED", ROOT.parent / "shared")) / "datasets"
FIRE = "pool_fire_T.nc"
# Name: file, title, options, and how wide the range is, of the step between neighbouring points in it.
SCENES = {
    "fire": (FIRE, "Pool fire, 600 to 1000 K", ["--variable", "T", "--range", "600:1000"], 3),
    "fire_edge": (FIRE, "Pool fire, 320 to 400 K", ["--variable", "T", "--range", "320:400"], 0.9),
    "fire_shell": (FIRE, "Pool fire, 845 to 855 K", ["--variable", "T", "--range", "845:855"], 0.05),
    "tooth": ("tooth_u8.nrrd", "Tooth, 80 to 90", ["--range", "80:90"], 1.9),
    "aneurism": ("aneurism_256_u8.vti", "Aneurism, 100 to 120", ["--range", "100:120"], 0.16),
    "hurricane": ("isabel_windspeed_4d.nrrd", "Hurricane Isabel, 39.5 to 40.5 m/s", ["--range", "39.5:40.5"], 0.17),
    "ocean": ("woa_temp_monthly_f32.nc", "Ocean in August, 9.5 to 10.5 °C", ["--step", "7", "--range", "9.5:10.5"], 0.5),
}
# What a scientist may want to know of each: what is lost, when, and what it buys.
MEANING = {
    "fire": "The hot gas is a body, three steps between points wide where it is thinnest. Points show all of it, with a ragged edge; what they lose is where "
            "exactly it ends, a tenth of the depth along a ray. Cells give the edge for four times the time, of which a moving picture needs little: "
            "in coarse pixels they are still four times as true as points.",
    "fire_edge": "The mantle of warm air about the fire is about as thick as points are apart. Points still show where it is, but a twentieth of it is missing, "
                 "and each ray is off by a seventh: enough to look at it, too little to compare its thickness at two places. Cells are right to half a hundredth.",
    "fire_shell": "The front between 845 and 855 K is twenty times thinner than points are apart, so hardly one lies in it: by points it is dust, wrong by more than "
                  "all of it, and subsets of dust are dust. Cells draw the closed surface that it is, in 1.5 to 2 ms; their 6 % are where it turns within a cell. "
                  "Coarse pixels lose a third of it, for it is thinner than they are.",
    "tooth": "Bytes of a scan, with its noise. A range of whole numbers reaches half a step farther between points than at them, so points have a fifth too much "
             "in all: a mean over them misleads. Cells cost twenty times as much here, since there are many of them and each is small on the screen: look around by points, "
             "read off by cells.",
    "aneurism": "Walls of vessels, a sixth of a step thick, in a volume that is mostly empty. By points a ray is wrong by three fifths, and walls are speckled; cells keep them whole, and are worth "
                "their 30 to 35 ms where a diameter is to be seen. Coarse pixels are half as wrong as points are.",
    "hurricane": "Wind of 40 m/s is a sheet about the eye. By points it is a cloud that hints at it, half wrong on a ray; by cells it is one sheet, in 2 to 3 ms, and nothing is gained "
                 "by leaving anything out.",
    "ocean": "Levels lie 10 m apart above and 100 below, so a point stands for a slab that is ten times as thick below, and is drawn as one: slower than cells, which take the layer of 10 °C "
             "between the levels as it is. There is no reason for points here but that they are what was measured.",
}
MOST_LIT = 1.3  # times the frame of cells that are not lit


def asked(width):
    """The error of cells that is asked for at most."""
    return 0.01 if width >= 1 else 0.03 if width >= 0.3 else 0.12


def measure(name):
    file, _, options, _ = SCENES[name]
    if not (DATA / file).exists():
        print(f"{name}: {file} is not there", file=sys.stderr)
        return
    print(f"{name} ...", file=sys.stderr)
    about = {"commit": commit(PAGE, PLOTS), "date": datetime.date.today().isoformat(),
             "load": os.getloadavg()[0]}
    figures = json.loads(said(PROGRAM, "measure", DATA / file, *options, "--opacity-per", "length", "--splatter", "cpu",
                              "--size", "600x600", "--json", "--svg", ROOT / PLOTS / f"{name}.svg"))
    crossing = json.loads(said(PROGRAM, "measure", DATA / file, *options, "--opacity-per", "crossing", "--splatter", "cpu",
                               "--size", "600x600", "--modes", "cells,coarse cells", "--json"))
    KEPT.mkdir(parents=True, exist_ok=True)
    (KEPT / f"{name}.json").write_text(json.dumps({"about": about, "figures": figures, "crossing": crossing}, indent=1))


def kept(name):
    file = KEPT / f"{name}.json"
    return json.loads(file.read_text()) if file.exists() else None


def time(seconds):
    if seconds >= 1:
        return f"{seconds:.3g} s"
    return f"{1e3 * seconds:.3g} ms" if seconds >= 1e-3 else f"{1e6 * seconds:.3g} µs"


def mass(mode):
    text = f"{100 * (mode['mass'] - 1):+.1f} %"
    return f"**{text}**" if mode["massIsOff"] else text


def popping(mode):
    return f"{mode['popping']:.3f}" if "popping" in mode else ""  # older figures have none


def is_lit(mode):
    return mode.get("light", "off") != "off"  # older figures have none


def in_float(mode):
    return f"{mode['arithmeticError']:.0e}" if mode.get("arithmeticError") is not None else ""


def best(figures, limited, limit, wanted):
    """As `isochron measure` tells it: of the modes whose mass is right and whose colours are not mixed."""
    order = figures["modes"][0]["order"]
    fit = [m for m in figures["modes"] if not m["massIsOff"] and m["order"] == order and not is_lit(m)
           and m[limited] <= limit]
    if not fit:
        return "none"
    m = min(fit, key=lambda mode: mode[wanted])
    return f"{m['mode']}, {m['depthError']:.3f}" if wanted == "depthError" else f"{m['mode']}, {time(m['frame'])}"


def choices(scenes):
    times, errors = [0.005, 0.01, 0.02, 0.05, 0.5], [0.5, 0.2, 0.1, 0.05, 0.01]
    title = lambda name: SCENES[name][1]
    return f"""The most accurate picture that a time allows, and its error (of modes whose mass is right):

{table(["scene", *(time(t) for t in times)],
       [[title(n), *(best(d["figures"], "frame", t, "depthError") for t in times)] for n, d in scenes])}
The soonest picture that an error allows, and its time:

{table(["scene", *(f"{e:g}" for e in errors)],
       [[title(n), *(best(d["figures"], "depthError", e, "frame") for e in errors)] for n, d in scenes])}"""


def find(figures, name):
    """By depth, where both orders were drawn."""
    return next(m for m in figures["modes"] if m["mode"] == name)


def rows_of(figures):
    for m in figures["modes"]:
        yield [m["mode"], m["order"], time(m["frame"]), time(m["before"]), f"{m['drawn']:,}",
               f"{m['depthError']:.3f}", mass(m), in_float(m), popping(m), f"{m['rmse']:.1e}",
               "" if m["psnr"] is None else f"{m['psnr']:.1f} dB", f"{m['colorDifference']:.1f}"]


def summary(scenes):
    rows = []
    for name, data in scenes:
        points, cells, coarse = (find(data["figures"], mode) for mode in ("points", "cells", "coarse cells"))
        lit = next((m for m in data["figures"]["modes"] if is_lit(m)), None)
        most, light = asked(SCENES[name][3]), lit["frame"] / cells["frame"] if lit else 0
        missed = lambda text, is_missed: f"**{text}**" if is_missed else text
        rows.append([SCENES[name][1], f"{SCENES[name][3]:g}", f"{points['depthError']:.3f}", mass(points), time(points["frame"]),
                     missed(f"{cells['depthError']:.3f}", cells["depthError"] > most), f"{most:g}", mass(cells), time(cells["frame"]),
                     f"{cells['frame'] / points['frame']:.1f}", f"{coarse['depthError']:.3f}", time(coarse["frame"]), time(lit["frame"]) if lit else "",
                     missed(f"{light:.2f}", light > MOST_LIT) if lit else ""])
    return table(["scene", "range / step", "points: error", "mass", "frame", "cells: error", "asked", "mass", "frame", "cells / points",
                  "coarse cells: error", "frame", "lit cells: frame", "lit / cells"], rows)


def reading(scenes):
    """What the figures say, in words; the numbers are those of the table."""
    both = [(find(d["figures"], "points"), find(d["figures"], "cells")) for _, d in scenes]
    span = lambda values, form: f"{form.format(min(values))} to {form.format(max(values))}"
    lost = [p["depthError"] for p, _ in both]
    kept_ = [c["depthError"] for _, c in both]
    slower = [c["frame"] / p["frame"] for p, c in both]
    off = sum(p["massIsOff"] for p, _ in both)
    fewer = [find(d["figures"], "points 1/8")["depthError"] / find(d["figures"], "points")["depthError"] for _, d in scenes]
    coarse = [find(d["figures"], "coarse cells") for _, d in scenes]
    sooner = [k["frame"] / c["frame"] for k, (_, c) in zip(coarse, both)]
    blurred = [100 * k["depthError"] for k in coarse]
    return (f"""A point stands for all that is nearest to it, and is drawn or not as its own value lies in the range or not. Where the range is
wider than the step from one point to the next, few are wrongly in or out, and points are a fair picture. Where it is thinner, most of
what lies in the range passes between points: the closed shell becomes dots. Over these scenes what is measured in a picture by points, its optical
depth, is wrong by {span([100 * e for e in lost], '{:.0f}')} %. In {off} of these {len(both)} scenes its sum is more than 5 % off as well (bold), so that even a mean over the picture misleads.
Cells take what each ray truly has of the range between the points: {span([100 * e for e in kept_], '{:.1f}')} %, for {span(slower, '{:.1f}')} times the time of a frame.
What a moving picture may leave out, cells first: summed in pixels twice as wide, under lines and text as sharp as ever (coarse), they take {span(sooner, '{:.2f}')} of
that time at an error of {span(blurred, '{:.1f}')} %. One point of eight, larger: the mass stays that of the points, while the error grows by {span(fewer, '{:.1f}')}
times. So: points to look around, cells for a thin range or for anything that is read off the picture; and neither tells
what the field does between its points beyond a linear guess, which is what this truth is.
""")


def stated(scenes):
    """What a picture says of its own error, beside what was measured."""
    rows, ratios = [], []
    for name, data in scenes:
        figures = data["figures"]
        order = figures["modes"][0]["order"]
        modes = [m for m in figures["modes"] if m["order"] == order and not is_lit(m) and m.get("sampledError") is not None]
        ratios += [m["sampledError"] / m["depthError"] for m in modes]
        rows.append([SCENES[name][1], *(f"{m['sampledError']:.3f} ({m['depthError']:.3f})" for m in modes)])
        names = [m["mode"] for m in modes]
    if not ratios:
        return ""
    near = sum(0.5 <= r <= 2 for r in ratios)
    return f"""A picture states its error from some of its pixels, against the same truth; in brackets what was measured of all of them. {near} of {len(ratios)} are
within a factor of two ({100 * near / len(ratios):.0f} %; nine of ten are asked for), the farthest off by a factor of {max(max(r, 1 / r) for r in ratios):.2f}.

{table(["scene", *names], rows)}"""


def crossings(scenes):
    """As a picture is drawn where nothing else is asked for."""
    rows = []
    for name, data in scenes:
        if "crossing" not in data:
            return ""
        cells, coarse = (find(data["crossing"], mode) for mode in ("cells", "coarse cells"))
        rows.append([SCENES[name][1], *(cell for mode in (cells, coarse) for cell in (f"{mode['depthError']:.3f}", f"{mode['sampledError']:.3f}", mass(mode), in_float(mode)))])
    return f"""All of this is of opacity by length, which points have, too. By crossing, as cells are drawn where nothing else is asked for, a passage
through a whole range counts as much as its opacity says; beside the error what a picture states of it:

{table(["scene", "cells: error", "stated", "mass", "in float", "coarse cells: error", "stated", "mass", "in float"], rows)}"""


def left_in(scenes):
    """What a moving picture does not leave out, and what that would buy."""
    rows, shares, farther = [], [], 0
    for name, data in scenes:
        modes = data["figures"]["modes"]
        cells, coarse = (find(data["figures"], mode) for mode in ("cells", "coarse cells"))
        mixed = next((m for m in modes if m["mode"] == "cells" and m["order"] == "mixed"), None)
        lit = next((m for m in modes if is_lit(m)), None)
        if not mixed or not lit or mixed is cells:
            continue
        farther += mixed["rmse"] > coarse["rmse"]
        shares.append((mixed["frame"] / cells["frame"], coarse["frame"] / cells["frame"], cells["frame"] / lit["frame"]))
        rows.append([SCENES[name][1], f"{cells['rmse']:.1e}", f"{shares[-1][1]:.2f}", f"{coarse['rmse']:.1e}",
                     f"{shares[-1][0]:.2f}", f"{mixed['rmse']:.1e}", f"{shares[-1][2]:.2f}"])
    if not rows:
        return ""
    mixed, coarse, dark = (f"{min(s):.2f} to {max(s):.2f}" for s in zip(*shares))
    return f"""Order and light stay while a picture moves. Without order cells would take {mixed} of their frame, in coarse pixels they take {coarse}; mixed colours are farther
off than coarse ones in {farther} of {len(rows)} scenes, and nearer where a range is thin. Without light cells would take {dark} of their frame, and what moves would be another
picture than what rests. Opacity is by length:

{table(["scene", "cells: RMSE", "coarse cells: of the frame", "RMSE", "without order: of the frame", "RMSE", "without light: of the lit frame"], rows)}"""


# What others had, where nothing can be measured.
NOT_BUILT = """Two more models were looked at in the design and not built: a soft weight, by which a point counts by how much of what lies about it is in the
range, and an ellipse that has the moments of that part, both told by central differences. These figures are the design's, of programs of its own; this program has not measured
them. Over the same seven scenes, of optical depth: soft weights 9 to 58 %, ellipses 8 to 73, beside 9 to 78 of points and 0.3 to 10.5 of cells there; of
turbulence, a range of 0.03 of its spread, 30 and 19 %, beside 59 and 2.6. Both draw what is not there beyond extrema. More of it in [NOTES.md](NOTES.md).
"""


def page():
    scenes = [(name, kept(name)) for name in SCENES]
    scenes = [(name, data) for name, data in scenes if data]
    if not scenes:
        sys.exit("nothing was measured yet")
    first = scenes[0][1]["figures"]
    cpu = processor()
    text = f"""# Speed against accuracy

`tests/bench/trade.py` makes this page by `isochron measure`. {cpu}, {first['threads']} threads; what a GPU draws stands in [GPU.md](GPU.md).
{first['size'][0]} x {first['size'][1]} pixels, {len(first['views'])} views, {first['frames']} frames of each, their median. A frame is order, splats or cells, and light,
without axes and legend. Error is the relative L2 of optical depth, and mass its sum, against the truth: the interval volume of the
field that is trilinear between its points, exact along each ray, the mean of {first['rays']} x {first['rays']} rays a pixel. RMSE, PSNR and the 95th percentile of
CIEDE2000 (where something shows; 1 is about what an eye can tell) are of the picture in linear light, against the light of the same
truth in exact order, lit as they are where cells are lit. In float is what arithmetic alone does to the depth, against the same splats or
cells in double: no part of the model's error. Popping is how much the picture's depth changes, and the truth's does not, when the view turns by 0.1 degree.

{reading(scenes)}
{NOT_BUILT}
By depth, where a scene has more than one colour:

{summary(scenes)}
Bold is what misses what was asked for, or a mass that is off: cells an error that the width of the range against the step between neighbouring
points allows, light {MOST_LIT:g} times the frame of cells without it.

{choices(scenes)}
{left_in(scenes)}
{stated(scenes)}
{crossings(scenes)}"""
    head = ["mode", "order", "frame", "before", "drawn", "error", "mass", "in float", "popping", "RMSE", "PSNR", "ΔE 95 %"]
    for name, data in scenes:
        about, figures = data["about"], data["figures"]
        text += (f"\n## {SCENES[name][1]}\n\n`{SCENES[name][0]}`, step {figures['step']}, {figures['points']:,} points. "
                 f"*Commit {about['commit']}, {about['date']}, load {about['load']:.1f} at its start.*\n\n{MEANING[name]}\n\n"
                 + table(head, rows_of(figures)))
        if (ROOT / PLOTS / f"{name}.svg").exists():
            text += f"\n![{SCENES[name][1]}: error against time]({pathlib.Path(PLOTS).name}/{name}.svg)\n"
    (ROOT / PAGE).write_text(text)


def main(arguments):
    names = [a for a in arguments if a != "--page"]
    if unknown := [n for n in names if n not in SCENES]:
        sys.exit(f"{unknown[0]}: no such scene; there are: {' '.join(SCENES)}")
    if "--page" not in arguments:
        for name in names or SCENES:
            measure(name)
    page()


if __name__ == "__main__":
    main(sys.argv[1:])
