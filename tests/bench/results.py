#!/usr/bin/env python3
"""Measures everything and writes tests/bench/RESULTS.md: one page, each figure once.

    tests/bench/results.py              builds, measures (some 20 minutes on two cores), writes the page
    tests/bench/results.py draw vtk     measures these parts again; the others stay as last measured
    tests/bench/results.py --page       writes the page from what was last measured

What a part measured stays in build/results, with its commit, time and load. On a quiet machine only:
what else runs is in the figures. The parts: index stages draw former cells foretold meshes store vtk window headset.
"""
import datetime
import json
import os
import re
import statistics
import subprocess
import sys

from pages import ROOT, commit, new_page, processor, table

KEPT = ROOT / "tests/bench/figures"
BENCH = ROOT / "build/release/tests/bench/isochron_bench"
# What each part runs; all but window and headset are filters of isochron_bench.
FILTERS = {
    "index": ["--benchmark_filter=^(build|select|count)", "--benchmark_repetitions=3",
              "--benchmark_report_aggregates_only=true"],
    "stages": ["--benchmark_filter=^stage"],
    "draw": ["--benchmark_filter=^(BM_[^F]|costFollows)"],
    "cells": ["--benchmark_filter=^(cell|tets|gradients)"],
    "foretold": ["--benchmark_filter=^BM_ForetoldFrame"],
    "meshes": ["--benchmark_filter=^mesh"],
    "vtk": ["--benchmark_filter=^vtk"],
    "store": ["--benchmark_filter=^store"],
}
PARTS = [*FILTERS, "former", "window", "headset"]
# The last commit before there were tiles: what speed was asked for beside it.
FORMER = "533f11b"
FORMER_FRAMES = [("BM_DrawUnordered/1000000/8", "1,000,000 splats of 8 px, one colour", 10), ("BM_DrawByValue/1000000/8", "1,000,000 splats of 8 px, by value", 9),
                 ("BM_DrawOrdered/1000000/8", "1,000,000 splats of 8 px, by value, back to front", 14),
                 ("BM_DrawUnordered/100000/8", "100,000 splats of 8 px, one colour", 12), ("BM_DrawOrdered/100000/8", "100,000 splats of 8 px, by value, back to front", 14),
                 ("BM_DrawUnordered/1000000/1", "1,000,000 splats of 1 px, one colour", 7),
                 ("BM_DrawEye/1000000/8", "1,000,000 splats of 8 px, by value, back to front, 1440 x 1600", 14)]


def shell(command, **options):
    return subprocess.run(["bash", "-c", command], cwd=ROOT, check=True, text=True, **options)


def said(command):
    return shell(command, stdout=subprocess.PIPE).stdout


def build():
    shell("source .ci/setup.sh; installPackages base vtk tests bench;"
          "configure release -DBUILD_TESTING=ON -DISOCHRON_VTK=ON -DISOCHRON_BENCH=ON;"
          "build release isochron_bench ui_bench")


def former():
    """Whole frames of that commit and of this one by turns, a process each: of every pair both times and their ratio."""
    there = ROOT / "build/former"
    if not there.exists():
        shell(f"git worktree prune; git worktree add --detach {there} {FORMER}")
    # Its benchmarks, with the scenes that it did not have.
    shell(f"cd {there} && git checkout --quiet . && git apply {ROOT}/tests/bench/former.patch")
    shell(f"cd {there}; source .ci/setup.sh; configure release -DISOCHRON_BENCH=ON; build release isochron_bench isochron")
    names = "|".join(name for name, *_ in FORMER_FRAMES)
    figures = {name: [] for name, *_ in FORMER_FRAMES}
    for _ in range(7):
        pair = [{re.sub("/(process_time|real_time)", "", f["run_name"]): 1e3 * seconds(f) for f in json.loads(said(
                    f"{bench} '--benchmark_filter=^({names})/' --benchmark_min_time=0.3 --benchmark_format=json 2>/dev/null"))["benchmarks"]}
                for bench in (BENCH, there / "build/release/tests/bench/isochron_bench")]
        for name in figures:
            figures[name].append([now[name] for now in pair])
    picture = json.loads(said(f"ISOCHRON_FORMER={there}/build/release/app/isochron {BENCH} '--benchmark_filter=^formerPicture' --benchmark_format=json 2>/dev/null"))["benchmarks"][0]
    figures["picture"] = [[picture["now_ms"], picture["former_ms"]]]
    starts = openings(said(f"build/release/tests/ui/ui_bench --beside {there}/build/release/app/isochron"))
    figures["window"] = [[starts[", from an index"], starts[", by the other program"]]]
    return figures


def openings(text):
    """What ui_bench says of windows that open: milliseconds to the first picture, by what is said of each."""
    return {how.strip(): float(middle) for how, middle in re.findall(r"^from the start to 1 % of 512\^3(.*?) +\d+ times +median +([\d.]+) ms", text, re.M)}


def measure(part):
    about = {"commit": commit("tests/bench/RESULTS.md", "tests/bench/NOTES.md", "tests/bench/figures"), "date": datetime.date.today().isoformat(), "load": os.getloadavg()[0], "machine": processor()}
    print(f"{part} ...", file=sys.stderr)
    if part == "window":
        figures = said("build/release/tests/ui/ui_bench")
    elif part == "former":
        figures = former()
    elif part == "headset":
        figures = said("tests/xr/monado_root.sh make && tests/xr/monado_root.sh bench")
    else:
        flags = " ".join(f"'{flag}'" for flag in FILTERS[part])
        # VTK draws into a window only.
        figures = json.loads(said(f"xvfb-run -a {BENCH} {flags} --benchmark_format=json 2>/dev/null"))["benchmarks"]
    KEPT.mkdir(parents=True, exist_ok=True)
    (KEPT / f"{part}.json").write_text(json.dumps({"about": about, "figures": figures}, indent=1))


class Part:
    """What one part last measured."""

    def __init__(self, name):
        kept = KEPT / f"{name}.json"
        self.there = kept.exists()
        if not self.there:
            return
        data = json.loads(kept.read_text())
        self.about, self.figures = data["about"], data["figures"]
        self.label = ""
        if isinstance(self.figures, list):
            self.label = next((f["label"] for f in self.figures if f.get("label")), "")
            self.by_name = {}
            for f in self.figures:
                if f.get("aggregate_name", "median") == "median":
                    self.by_name[re.sub(r"/(iterations:\d+|process_time|real_time)", "", f["run_name"])] = f

    def __call__(self, name):
        return self.by_name.get(name)

    def line(self):
        a = self.about
        elsewhere = a.get("machine", processor())
        elsewhere = "" if elsewhere == processor() else f", on another machine: {elsewhere}"
        return f"*Commit {a['commit']}, {a['date']}, load {a['load']:.1f} at its start{elsewhere}.*\n"


SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


def seconds(figure):
    return figure["real_time"] * SECONDS[figure["time_unit"]]


def digits(value):
    return f"{value:.3g}" if value < 1000 else f"{value:,.0f}"


def time(value):
    if value is None:
        return ""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if value >= (0.9995 * size if unit != "s" else 10):
            return f"{digits(value / size)} {unit}"
    return f"{digits(value / 1e-9)} ns"


def ms(figure, counter):
    return time(1e-3 * figure[counter])


def points(n):
    return f"{n}³"


TARGETS = []


def target(what, value, limit, at_least=False, shown=digits):
    met = value >= limit if at_least else value <= limit
    TARGETS.append([what, shown(value), ("at least " if at_least else "at most ") + shown(limit),
                    "met" if met else "**missed**"])


def index_page(part):
    rows = []
    for n, kind in [(64, "float"), (128, "float"), (256, "float"), (512, "float"), (128, "double"), (128, "std::int16_t")]:
        built, sort = part(f"build<{kind}>/{n}"), part(f"buildByStdSort/{n}") if kind == "float" else None
        selected, counted = part(f"select<{kind}>/{n}"), part(f"count<{kind}>/{n}")
        scanned = part(f"countByScan<{kind}>/{n}")
        rows.append([points(n), kind.replace("std::", "").replace("_t", ""), time(seconds(built)),
                     digits(n**3 / seconds(built) / 1e6), digits(seconds(sort) / seconds(built)) if sort else "",
                     time(seconds(selected)), time(seconds(counted)), digits(seconds(scanned) / seconds(selected))])
        if (n, kind) == (256, "float"):
            target("build, 256³ floats, million points/s", n**3 / seconds(built) / 1e6, 45, at_least=True)
            target("`select`, 256³ floats", seconds(selected), 5e-6, shown=time)
    text = ("A field of waves whose amplitudes fall as in turbulence, and a little noise; 65,536 ranges between two random values of it, so that\n"
            "searches do not stay in the cache. `std::sort` sorts the same packed keys and need not unpack them; the scan compares every value\n"
            "(vectorised) and only counts. Building is on all cores, and leaves points to be put in order where a range ends or somebody looks."
            "\nThe rest is one thread's.\n\n")
    text += table(["points", "type", "build", "million points/s", "`std::sort` / build", "`select`", "`count`",
                   "scan / `select`"], rows)
    rows = []
    for n, kind, run, asked in [(128, "float", "build", None), (256, "float", "build", 5), (512, "float", "build", None),
                                (256, "int16", "build", 4), (256, "uint8", "build", 4), (256, "float", "buildWhole", None)]:
        f = part(f"{run}BesideFormer<{kind if kind == 'float' else f'std::{kind}_t'}>/{n}")
        if not f:
            continue
        rows.append([points(n), kind, "all put in order" if run == "buildWhole" else "", ms(f, "first_ms"), ms(f, "second_ms"),
                     digits(f["second/first"]), digits(f["cpu2/cpu1"])])
        if asked:
            target(f"build, 256³ {kind}: before / now", f["second/first"], asked, at_least=True)
    first = part("selectFirst<float>/256")
    return (text + "\nBeside the build as it was, everything sorted at once by one thread, by turns."
            + (f" The first range of a step of 256³ floats: {time(seconds(first))}.\n\n" if first else "\n\n")
            + table(["points", "type", "", "now", "before", "ratio", "of processor time"], rows))


def stages_page(part):
    rows = []
    for n in (64, 128, 256, 512):
        def of(stage, share=None):
            figure = part(f"{stage}/{n}" + (f"/{share}" if share else ""))
            return time(seconds(figure)) if figure else ""
        drawn = part(f"stageDraw/{n}/10")
        rows.append([points(n), of("stageReadNrrd"), of("stageReadNetcdf"), of("stageBuild"), of("stageUpload", 10),
                     of("stageOrder", 10), of("stageDraw", 100), of("stageDraw", 10), of("stageDraw", 1),
                     f"{drawn['diameter']:.1f} px"])
    text = ("The same field, seen whole in 1024 x 1024, one range about the median; files in the system's cache. Upload is a selection's first\n"
            "picture: buffers for the step, its blocks reordered and sent. Draw is the splats alone.\n\n")
    text += table(["points", "read NRRD", "read NetCDF-4", "build", "upload, 1 %", "order, 1 %", "draw, 10 %",
                   "draw, 1 %", "draw, 0.1 %", "splat"], rows)
    series = part("stageSeries/points:128")
    if series:
        target("pictures a second of a series of 128³, by points", 1e3 / series["points_png_ms"], 25, at_least=True)
        text += ("\n`render` of 120 steps of 128³ floats, 1 % of each, 1024 x 1024 pixels, milliseconds a picture:\n\n"
                 + table(["drawn by", "PNG", "OpenEXR"], [[model, digits(series[f"{model}_png_ms"]), digits(series[f"{model}_exr_ms"])]
                                                       for model in ("points", "cells")]))
    return text


def draw_page(part):
    rows = []
    for splats, diameter in [(1, 8), (100000, 8), (1000000, 8), (100000, 16), (1000000, 3)]:
        cells = [part(f"{name}/{splats}/{diameter}") for name in ("BM_DrawUnordered", "BM_DrawByValue", "BM_DrawOrdered")]
        rows.append([f"{splats:,}", f"{diameter} px"] + [time(seconds(c)) if c else "" for c in cells])
    target("a frame with 100,000 splats of 8 px", seconds(part("BM_DrawUnordered/100000/8")), 0.05, shown=time)
    text = ("A frame of 1024 x 1024 until `glFinish`: axes, order, draw list, splats, resolve. Splats scattered through 256³ points of noise.\n\n"
            + table(["splats", "diameter", "one colour", "by value", "by value, back to front"], rows))

    rows = []
    for selected, ordered, moving in [(0, 0, 0), (100000, 0, 1), (1000000, 0, 1), (1000000, 0, 0), (100000, 1, 1),
                                      (1000000, 1, 1), (1000000, 1, 0)]:
        f = part(f"BM_CanvasFrame/selected:{selected}/ordered:{ordered}/moving:{moving}")
        if f:
            rows.append([f"{selected:,}", "back to front" if ordered else "none", "yes" if moving else "no",
                         f"{f['drawn']:,.0f}", ms(f, "first_ms"), ms(f, "second_ms"), digits(f["second/first"]), digits(f["cpu2/cpu1"])])
            if selected == 0:
                target("a frame without splats, lines and labels, presented", 1e-3 * f["first_ms"], 0.002, shown=time)
    text += ("\nA window's frame with axes, legend and presentation; while it moves, at most 100,000 splats stand for all. The program makes it in memory;\n"
             "beside it, by turns, one that leaves all but the splats to GL, as all were before.\n\n"
             + table(["selected", "order", "moving", "drawn", "frame", "with GL", "ratio", "of processor time"], rows))
    small = [(name, part(run)) for name, run in [("axes and legend", "BM_AxesAndLegend"), ("light onto a window", "BM_Present"),
                                                ("a look at a million points (pick)", "BM_Pick/1000000")]]
    text += "\nOf it: " + "; ".join(f"{name} {time(seconds(f))}" for name, f in small if f) + ".\n"

    rows = []
    for n in (1000, 100, 10):
        f = part(f"costFollowsTheSelection/{n}")
        rows.append([f"{f['splats']:,.0f}", ms(f, "first_ms"), ms(f, "second_ms"), f"{f['second/first']:.3f}", f"{f['cpu2/cpu1']:.3f}"])
        target(f"{f['splats']:,.0f} splats from 512³ / from 64³ points", f["second/first"], 1.1)
    text += ("\n## Cost follows the selection\n\nAll points of 64³, and the same ones among 512³, whose others lie outside the range: same places, same picture, by turns.\n\n"
             + table(["splats", "from 64³", "from 512³", "ratio", "of processor time"], rows))

    rows = []
    for width, height in [(896, 1007), (1440, 1600)]:
        for splats in (10000, 100000, 1000000):
            f = part(f"BM_EyePair/splats:{splats}/width:{width}/height:{height}")
            rows.append([f"{width} x {height}", f"{splats:,}", ms(f, "first_ms"), ms(f, "second_ms"),
                         f"{f['second/first']:.2f}", f"{f['cpu2/cpu1']:.2f}"])
            if (width, splats) == (1440, 1000000):
                target("a pair of eyes / one eye, a million splats", f["second/first"], 1.8)
    text += ("\n## A pair of eyes\n\nOne eye and the pair by turns; order and upload are shared.\n\n"
             + table(["an eye's pixels", "splats", "one eye", "the pair", "ratio", "of processor time"], rows))

    rows = []
    for opacity, kernel in [(10, 1), (100, 1), (500, 1), (100, 0)]:
        f = part(f"BM_ErrorAgainstTruth/opacity/1000:{opacity}/kernel:{kernel}")
        rows.append(["(1 - q)⁴" if kernel else "point, 1 px", opacity / 1000, f"{f['meanTau']:.2g}", f"{f['depth']:.2g}",
                     f"{f['ordered']:.2g}", f"{f['unordered']:.2g}"])
        if (opacity, kernel) == (100, 1):
            target("optical depth against the double truth, relative L2", f["depth"], 1e-5)
    text += ("\n## Accuracy\n\nRelative L2 against the same model in double with an exact order: 512 x 512, noise on 64³ points of which a fifth is selected, by\n"
             "value. Light back to front has 22-bit keys; unordered it is another picture (a mean along the ray), good below a mean optical depth\n"
             "of 0.1 to 0.3. A point splat within float rounding of a pixel's border may fall to its other side.\n\n"
             + table(["kernel", "opacity a cell", "mean optical depth", "optical depth", "light, ordered", "light, unordered"], rows))
    rows = []
    for opacity in (20, 100, 500, 1000):
        f = part(f"BM_OffFragments/opacity/1000:{opacity}")
        if not f:
            continue
        rows.append([opacity / 1000, *(f"{f[where]:.2g}" for where in ("outside", "within", "face"))])
        if opacity in (100, 500):
            target(f"light in order against its fragments in order, opacity {opacity / 1000:g}, worst of three places, RMSE",
                   max(f[where] for where in ("outside", "within", "face")), 1e-3)
    text += ("\nSplats are in the order of their centres; beside their fragments in order, pixel by pixel, of a smooth field by value, RMSE of light:\n\n"
             + table(["opacity a cell", "from outside", "from within", "along a face"], rows))
    rows = []
    for stride in (1, 2, 8, 32, 128):
        grown = part(f"BM_Subset/stride:{stride}/grown:1")
        if grown:
            rows.append([stride, f"{grown['points']:,.0f}", f"{grown['error']:.2g}"])
    if rows:
        text += ("\nWhile a picture moves, one of so many points stands for its neighbours, larger, with their mass: relative L2 of light against all.\n\n"
                 + table(["one of", "points", "error"], rows))
    return text


def cells_page(part):
    built = part("cellIndex/256")
    per_second = 257**3 / seconds(built) / 1e6
    target("index of cells, 256³, million cells/s", per_second, 20, at_least=True)
    text = (f"The field of the index. Made at 256³: {time(seconds(built))}, {digits(per_second)} million cells/s on all cores. "
            "Ranges of so much of the\nfield's spread; looked at are the cells in its runs, needed those that it reaches into.\n\n")
    rows = []
    for thousandths in [1000, 100, 10]:
        f = part(f"cellSelect/{thousandths}")
        rows.append([f"{thousandths / 1000:g}", f"{int(f['cells']):,}", time(seconds(f)), digits(f["looked/needed"])])
        target(f"cells found at 256³, a range of {thousandths / 1000:g}", seconds(f), 30e-6, shown=time)
        target(f"cells looked at / needed, a range of {thousandths / 1000:g}", f["looked/needed"], 1.4)
    text += table(["range", "cells", "`select`", "looked at / needed"], rows)
    rows = []
    for n, thousandths, ordered in [(96, 100, 0), (96, 1000, 0), (96, 100, 1), (192, 100, 0)]:
        f = part(f"cellsBesidePoints/points:{n}/thousandths:{thousandths}/ordered:{ordered}")
        rows.append([points(n), f"{thousandths / 1000:g}", "front to back" if ordered else "none", f"{int(f['cells']):,}",
                     ms(f, "second_ms"), ms(f, "first_ms"), digits(f["second/first"])])
        if (n, ordered) == (96, 0):
            target(f"a cell / a splat, 96³, a range of {thousandths / 1000:g}", f["second/first"], 3)
        if n == 192:
            target("a picture of 192³ by cells, a range of 0.1, at rest", f["second_ms"] * 1e-3, 0.25, shown=time)
    text += ("\nDrawn in 1024 x 1024, one colour, beside as many points of the same field by tiles, by turns.\n\n"
             + table(["points", "range", "order", "cells", "cells drawn", "points drawn", "ratio"], rows))
    rows = []
    for n, what in [(0, "the pool fire, 600 to 1000 K"), (96, "96³, a range of 0.1"), (192, "192³, a range of 0.1")]:
        f = part(f"cellsLitBesideUnlit/points:{n}")
        rows.append([what, f"{int(f['cells']):,}", ms(f, "first_ms"), ms(f, "second_ms"), digits(f["second/first"])])
        target(f"cells in order, lit / not, {what}", f["second/first"], 1.3)
        if n == 0:
            target("a frame of the pool fire's 600 to 1000 K, lit, in order, 1024 x 1024", f["second_ms"] * 1e-3, 0.025, shown=time)
    text += ("\nWhole frames of 1024 x 1024, coloured by value and in order, lit beside not, by turns.\n\n"
             + table(["cells of", "cells", "not lit", "lit", "ratio"], rows))
    rows = []
    kinds = ["curvilinear", "hexahedra"]
    for n, thousandths, ordered in [(96, 100, 0), (96, 1000, 0), (96, 100, 1)]:
        for solids, kind in enumerate(kinds):
            f = part(f"cellsOfMeshBesideUpright/points:{n}/thousandths:{thousandths}/ordered:{ordered}/solids:{solids}")
            if f:
                rows.append([points(n), kind, f"{thousandths / 1000:g}", "front to back" if ordered else "none",
                             f"{int(f['cells']):,}", ms(f, "second_ms"), ms(f, "first_ms"), digits(f["second/first"])])
    if rows:
        text += ("\nThe same points placed one by one, whose cells are six tetrahedra each, beside those of the upright grid, by turns.\n\n"
                 + table(["points", "cells", "range", "order", "cells", "tetrahedra drawn", "upright cells drawn", "ratio"], rows))
    rows = []
    for solids, kind in enumerate(kinds):
        f, made = part(f"tetsLitBesideUnlit/solids:{solids}"), part(f"gradientsBesideCells/solids:{solids}")
        if f and made:
            rows.append([kind, ms(f, "first_ms"), ms(f, "second_ms"), digits(f["second/first"]),
                         ms(made, "second_ms"), digits(made["second/first"])])
            target(f"tetrahedra in order, lit / not, {kind}, 96³, a range of 0.1", f["second/first"], 1.3)
    if rows:
        text += ("\nFrames of the tetrahedra of 96³ points lit by the gradients of points, beside not lit; and how long these gradients of "
                 "128³ points take, which a step has once, beside its cells by value.\n\n"
                 + table(["cells", "not lit", "lit", "ratio", "gradients", "to cells by value"], rows))
    rows = []
    for solids, kind in enumerate(kinds):
        f = part(f"tetsByFacesBesideMiddles/solids:{solids}")
        if f:
            rows.append([kind, ms(f, "first_ms"), ms(f, "second_ms"), digits(f["second/first"])])
    if rows:
        text += ("\nFrames of them put in order by the faces between cells, as at rest and in files, beside the distance of cells' middles, as while the picture moves.\n\n"
                 + table(["cells", "by middles", "by faces", "ratio"], rows))
    rows = []
    for kind, name in enumerate(["upright", *kinds]):
        for ordered in (0, 1):
            f = part(f"cellsFromWithin/kind:{kind}/ordered:{ordered}")
            if f:
                rows.append([name, "front to back" if ordered else "none", ms(f, "first_ms"), ms(f, "second_ms"), digits(f["second/first"])])
    if rows:
        text += ("\nCells of 96³ points, a range of 1, from an eye among them, beside one that sees all from outside.\n\n"
                 + table(["cells", "order", "from outside", "from within", "ratio"], rows))
    under = [(kind, part(f"cellUnderCursorOfMesh/points:96/thousandths:1000/solids:{solids}")) for solids, kind in enumerate(kinds)]
    if all(f for _, f in under):
        text += "\nUnder the cursor, of " + " and of ".join(
            f"{int(f['cells']):,} cells ({kind}) {time(seconds(f))}" for kind, f in under) + ".\n"
    return text


def foretold_page(part):
    rows = []
    for cells in (1, 0):
        for ordered in (0, 1):
            for noise in (0, 1):
                f = part(f"BM_ForetoldFrame/noise:{noise}/cells:{cells}/ordered:{ordered}")
                what, field = ("cells" if cells else "points"), ("noise" if noise else "waves")
                order = "front to back" if ordered else "none"
                rows.append([what, field, order, f"{100 * f['within25']:.0f} %", digits(f["middling"]), digits(f["worst"])])
                target(f"frames of {what} of {field}, order {order}, foretold within 25 %, share", f["within25"], 0.9, at_least=True)
    return ("Twelve pictures of a field, 600 x 600, from four distances with three ranges; the time of each is foretold as a window does, from what the others took,\n"
            "and held against the median of its 50 frames. Foretold over taken: the one in the middle, and the worst.\n\n"
            + table(["drawn by", "field", "order", "within 25 %", "middling", "worst"], rows))


def meshes_page(part):
    rows = []
    for splats, what in [(1000000, 0), (1000000, 2), (100000, 0), (100000, 2)]:
        kind = {0: "one colour", 2: "by value, back to front"}[what]
        for cubes, cells in [(1, "cubes"), (0, "stretched")]:
            f = part(f"meshBesideUpright/splats:{splats}/pixels:8/what:{what}/cubes:{cubes}")
            rows.append([f"{splats:,}", "8 px", kind, cells, ms(f, "first_ms"), ms(f, "second_ms"), digits(f["second/first"]), digits(f["cpu2/cpu1"])])
            target(f"a frame of {splats:,} splats of a mesh / of {cells if cubes else 'an upright grid'}, {kind}", f["second/first"], 1.6)
    return ("The points of 256³ placed one by one, beside the same ones of the upright grid, whose cells are cubes, of which all splats are alike,\n"
            "or stretched along one axis: whole frames of 1024 x 1024 until `glFinish`, order included, by turns.\n\n"
            + table(["splats", "diameter", "", "cells", "upright", "mesh", "ratio", "of processor time"], rows) + opening_page(part))


def store_page(part):
    rows = []
    for n, thousandths in [(256, 10), (512, 1), (512, 10), (512, 100)]:
        f = part(f"storeRange/points:{n}/thousandths:{thousandths}")
        rows.append([points(n), f"{thousandths / 10:g} %", f"{f['read'] / 1e6:.2f} MB", ms(f, "first_ms"), time(1e-3 * f["cold_ms"]),
                     ms(f, "second_ms"), digits(f["second/first"]), digits(f["cpu2/cpu1"])])
        if (n, thousandths) == (512, 10):
            target("a range of 1 % of 512³ on disk, MB read", f["read"] / 1e6, 2.5)
            target("the same, opened, selected and decoded, warm", 1e-3 * f["first_ms"], 0.01, shown=time)
            target("the same, cold", 1e-3 * f["cold_ms"], 0.02, shown=time)
            target("the same: read and sorted / from disk", f["second/first"], 20, at_least=True)
        if thousandths == 10:
            target(f"a step of {points(n)} floats on disk, bytes of ids a point", f["ids"], 1.2 if n == 256 else 1.6)
            target(f"a step of {points(n)} floats on disk, bytes a point in all", f["file"], 3.45)
    f = part("storeWrite/points:256")
    rate = lambda ms: f["points"] / ms / 1e3
    target("read, sorted and written on one thread, million points/s", rate(f["second_ms"]), 22, at_least=True)
    target("read, sorted and written, two threads / one", f["second/first"], 1.8, at_least=True)
    return ("The field of the index, in floats; ranges about the median, from nothing: the file and its index opened, the range selected, its points read.\n"
            "Cold: without the index in the system's cache (the file, which the other side reads, stays there). By turns with reading the file and sorting.\n\n"
            + table(["points", "range", "read", "from disk, warm", "cold", "read and sorted", "ratio", "of processor time"], rows)
            + f"\nRead, sorted and written, 256³: {ms(f, 'second_ms')} on one thread, {ms(f, 'first_ms')} on both, {digits(rate(f['second_ms']))} and "
            f"{digits(rate(f['first_ms']))} million points/s.\n" + picture_page(part) + series_page(part) + large_page(part) + ranks_page(part))


def picture_page(part):
    f = part("storePicture/points:512")
    if not f:
        return ""
    rows = []
    for model in ["cells", "points"]:
        ratio = f[f"{model}_file_ms"] / f[f"{model}_index_ms"]
        rows.append([model] + [cell for side in ["file", "index"] for cell in (ms(f, f"{model}_{side}_ms"), f"{f[f'{model}_{side}_MB']:,.0f} MB")]
                    + [digits(ratio)])
    target("`index` of a step of 512³ floats, memory / the step's bytes", f["index_MB"] * 1e6 / (4 * 512**3), 2.5)
    return (f"\n`index` of 512³ floats takes {ms(f, 'index_ms')} and {f['index_MB']:,.0f} MB; `render` of 1 % of them about the median, 1200 x 900 pixels, the error\n"
            "that the picture states included:\n\n"
            + table(["drawn by", "without an index", "most memory", "with one", "most memory", "ratio"], rows))


def series_page(part):
    f = part("storeSeries/steps:10000")
    if not f:
        return ""
    target("10,000 sorted steps opened, to the points of the first", 1e-3 * f["first_ms"], 1, shown=time)
    target("the same by `render`, to the first's picture", 1e-3 * f["picture_ms"], 1, shown=time)
    return (f"\n10,000 sorted steps of 64³ points (names of one file) opened as a series, to the points of the first: {ms(f, 'first_ms')}; by `render`, to its\n"
            f"picture, 1200 x 900 pixels: {ms(f, 'picture_ms')}.\n")


def large_page(part):
    f = part("storeLarge/points:1024")
    if not f:
        return ""
    share = f"{100 * f['selected'] / 1024**3:.2g} %"
    target(f"a step of 1024³ bytes from disk, {share} of it drawn by the program, MB of memory", f["render_MB"], 2000)
    target("the same without an index", 1e-3 * f["alone_ms"], 3, shown=time)
    target("the same, MB of memory", f["alone_MB"], 2500)
    rows = [[what, ms(f, f"{key}_ms"), f"{f[f'{key}_MB']:,.0f} MB"] for what, key in
            [("drawn without an index: `render --cache off`", "alone"), ("sorted and written: `index`", "index"),
             ("counted: `count`", "count"), ("drawn: `render`", "render")]]
    target("`index` of the same, memory / the step's bytes", f["index_MB"] * 1e6 / 1024**3, 2.5)
    return (f"\nThe program on a step of 1024³ values of 8 bits, one of which, that of {f['selected']:,.0f} points ({share}), is asked for, 1200 x 900 pixels:\n\n"
            + table(["", "time", "most memory"], rows))


def ranks_page(part):
    f = part("storeRanks/points:400")
    if not f:
        return ""
    target("the same file by mpirun, two processes / one", f["second/first"], 1.7, at_least=True)
    return (f"\nA file of 400³ floats read, sorted and written under mpirun, one thread each: {ms(f, 'second_ms')} by one process, {ms(f, 'first_ms')} by two, "
            f"which read, sort and write the step together: {digits(f['second/first'])} times as fast.\n")


def opening_page(part):
    rows = []
    for side, bent in [(100, 0), (100, 1), (170, 0), (170, 1)]:
        f = part(f"meshOpen/side:{side}/bent:{bent}")
        if not f:
            return ""
        rows.append([points(side), "bent" if bent else "parallelepipeds", ms(f, "first_ms"), ms(f, "second_ms"), digits(f["second/first"]), digits(f["cpu2/cpu1"])])
        if side == 170:
            target(f"5 million hexahedra opened / by VTK's reader, {'bent' if bent else 'straight'}", f["second/first"], 2)
    text = ("\nHexahedra of a .vtu file, appended raw, opened and read, their cells measured, beside VTK's reader, which measures none.\n\n"
            + table(["hexahedra", "", "VTK", "ours", "ratio", "of processor time"], rows))
    if many := part("meshSeries/steps:4500"):
        target("4,500 small .vtu steps opened, to the values of the first", 1e-3 * many["first_ms"], 1, shown=time)
        text += f"\n4,500 numbered .vtu files of 10³ hexahedra opened as a series, to the values of the first step: {ms(many, 'first_ms')}.\n"
    return text


def vtk_page(part):
    rows = []
    for count, diameter in [(100000, 8), (1000000, 8), (100000, 0), (1000000, 0)]:
        f = part(f"vtkDraw/points:{count}/diameter:{diameter}")
        rows.append([f"draw {count:,} splats of {diameter or 1} px", "`vtkPointGaussianMapper`", ms(f, "first_ms"), ms(f, "second_ms"),
                     digits(f["second/first"]), digits(f["cpu2/cpu1"])])
        if diameter == 8:
            target(f"{count:,} splats of 8 px, VTK / ours", f["second/first"], 2 if count == 100000 else 28, at_least=True)
    for run, what, theirs in [("vtkSelect/{}", "select and count {}", "`vtkThresholdPoints`"),
                              ("vtkSelectToDraw/{}", "the same, ready to draw, {}", "`vtkThresholdPoints`"),
                              ("vtkContour/{}", "1 % about the median, ready to draw, {}", "`vtkFlyingEdges3D`"),
                              ("vtkOrder/{}", "back to front, {}", "`vtkDepthSortPolyData`")]:
        for n, share in [(128, 10), (256, 100), (256, 10), (256, 1), (512, 10), (256, 60), (256, 6)]:
            f = part(run.format(f"{n}/{share}"))
            if not f:
                continue
            of = f"{f['points']:,.0f} points" if "Order" in run else points(n) + ("" if "Contour" in run else f", {share / 10:g} %")
            rows.append([what.format(of), theirs, ms(f, "first_ms"), ms(f, "second_ms"), digits(f["second/first"]), digits(f["cpu2/cpu1"])])
            if "ToDraw" in run and share == 10 and n > 128:
                target(f"1 % of {points(n)} selected and ready to draw, VTK / ours", f["second/first"], 1.7, at_least=True)
    for n in (256, 512):
        f = part(f"vtkFirstPicture/points:{n}")
        if not f:
            continue
        rows.append([f"first picture of 1 % of {points(n)}, program start, reading and PNG included", "`vtkThresholdPoints`, `vtkPointGaussianMapper`", ms(f, "now_ms"), ms(f, "vtk_ms"),
                     digits(f["vtk_ms"] / f["now_ms"]), ""])
        target(f"first picture of 1 % of {points(n)} without an index, VTK / ours", f["vtk_ms"] / f["now_ms"], 1.7, at_least=True)
    text = ("Ours and VTK's by turns, the same points, view and picture; all threads' processor time beside the clock's. VTK's splats blend into 8\n"
            "bits and its frame has no axes; its points are uploaded before. A contour is VTK's surface beside our points about the same value.\n\n")
    return text + table(["what", "VTK's", "ours", "VTK", "VTK / ours", "of processor time"], rows)


def window_page(part):
    rows = re.findall(r"^(.+?) +(\d+) times +median +([\d.]+) ms +longest +([\d.]+) ms", part.figures, re.M)
    asked = {"from a drag's end to all of a million points": 33.3, "from a drag to the changed picture": 33.3, "between frames, turning, the pool fire": 16.7, "between frames, turning, 1 % of 512^3": 33.3,
             "between frames, turning, a million points": 33.3, "between frames, turning, all of a million points": 33.3, "between steps, 256^3, read on the way": 100,
             "between steps, 1 % of 512^3, from a cold disk": 100,
             "between steps, 256^3, from memory": 66.7, "between windows, a shell swept through the fire": 50}
    for what, _, middle, _ in rows:
        if what.strip() in asked:
            target(f"window: {what.strip().replace('^3', '³')}", float(middle) * 1e-3, asked[what.strip()] * 1e-3, shown=time)
    shell = re.search(r"^a shell swept through the fire has while it moves ([\d.]+) of its pixels at rest, at least ([\d.]+)", part.figures, re.M)
    if shell:
        target("window: pixels of a shell swept through the fire, while it moves / at rest", float(shell[1]), 0.8, at_least=True)
    memory = {what: float(most) for what, most in re.findall(r"^(between steps, .*? shown), most memory (\d+) MB", part.figures, re.M)}
    for what, most in memory.items():
        if "1024" in what:
            target(f"window: {what.replace('^3', '³')}: MB of memory", most, 2000)
    return ("`ui_bench`: the real program under Xvfb; a frame is told by the window's answer to a ping, asked for every 5 ms.\n\n"
            + table(["", "median", "longest"], [[what.strip(), f"{middle} ms", f"{longest} ms"] for what, _, middle, longest in rows])
            + ("".join(f"\nMost memory {what}: {most:,.0f} MB.\n" for what, most in memory.items())))


def headset_page(part):
    tables = "\n".join(line for line in part.figures.splitlines() if line.startswith("|") or not line.strip())
    return ("`tests/xr/monado_root.sh bench`: Debian 13, Monado's compositors on the same cores. First what the XR layer costs by itself, a\n"
            "frame; then frames that came and periods that were missed.\n\n" + tables.strip() + "\n")


def former_page(part):
    rows = []
    for name, what, asked in FORMER_FRAMES:
        pairs = part.figures.get(name)
        if not pairs:
            continue
        ratio = statistics.median(before / now for now, before in pairs)
        rows.append([what, *(time(1e-3 * statistics.median(side)) for side in zip(*pairs)), digits(ratio)])
        target(f"a frame of {what}: at {FORMER} / now", ratio, asked, at_least=True)
    for figure, where in (("picture", "first picture"), ("window", "first picture in a window")):
        for now, before in part.figures.get(figure, []):
            rows.append([f"{where} of 512³ by points", time(1e-3 * now), time(1e-3 * before), digits(before / now)])
            target(f"{where} of 1 % of 512³ by points: at {FORMER} / now, with an index", before / now, 20, at_least=True)
    return (f"A whole frame, of 1024 x 1024 where nothing else is said, until `glFinish`, resolve included, as it is now and at {FORMER}, the last commit before there were tiles: its own\n"
            "benchmarks, built and run by turns with these, seven times. The first picture is `render`'s, 1200 x 900, of 1 % about the median, now from an\n"
            "index and with its error, which that commit does not tell; in a window from the program's start on, the driver's included, of noise.\n\n" + table(["", "now", f"at {FORMER}", "ratio"], rows))


def page():
    sections = [("index", "The index", index_page), ("stages", "From a file to a picture", stages_page),
                ("draw", "Drawing", draw_page), ("former", "Beside the program before tiles", former_page), ("cells", "Cells", cells_page), ("foretold", "A frame foretold", foretold_page), ("store", "Sorted steps on disk", store_page), ("meshes", "Curvilinear grids", meshes_page), ("vtk", "Beside VTK", vtk_page), ("window", "The window", window_page),
                ("headset", "In a headset", headset_page)]
    body, driver = "", ""
    for name, title, write in sections:
        part = Part(name)
        if part.there:
            body += f"\n# {title}\n\n{part.line()}\n{write(part)}"
            driver = driver or part.label
    cpu = processor()
    memory = int(said("sed -n 's/^MemTotal: *\\([0-9]*\\).*/\\1/p' /proc/meminfo")) // 2**20
    system = said("sed -n 's/^PRETTY_NAME=\"\\(.*\\)\"/\\1/p' /etc/os-release").strip()
    compiler = said("g++ --version | head -n 1").strip()
    head = f"""# Measured

`tests/bench/results.py` makes this page; what was tried and not kept is in `NOTES.md`. Medians; a ratio is of one run, its sides by turns.

Machine: {cpu}, {os.cpu_count()} cores, {memory} GiB; {system}, {compiler}, `-O3` without `-march`. {driver or 'llvmpipe'}: no GPU. A new page of 4 KiB takes {digits(new_page())} µs.

"""
    (ROOT / "tests/bench/RESULTS.md").write_text(
        head + table(["what", "measured", "asked for", ""], TARGETS) + body)


def main(arguments):
    parts = [a for a in arguments if a != "--page"]
    if unknown := [p for p in parts if p not in PARTS]:
        sys.exit(f"{unknown[0]}: no such part; there are: {' '.join(PARTS)}")
    if "--page" not in arguments:
        build()
        for part in parts or PARTS:
            measure(part)
    page()


main(sys.argv[1:])
