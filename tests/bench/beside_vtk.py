#!/usr/bin/env python3
"""Draws value ranges with isochron and with VTK's ray caster on the processor: beside_vtk_*.png and their README section.

    xvfb-run -a tests/bench/beside_vtk.py FOLDER          draws and measures (two minutes), writes the section
    xvfb-run -a tests/bench/beside_vtk.py FOLDER tooth    these scenes again; the others stay as last measured
    tests/bench/beside_vtk.py --page                      writes the section from what was last measured

FOLDER has the data that the project does not ship; what is not there is left out. What was measured stays in
build/beside_vtk, and pictures with both on top of each other and VTK's outline of the box, to see that their
cameras agree. Needs build/release, python3-vtk9 and xvfb. On a quiet machine only: what else runs is in the times,
and it says how much of the processors VTK had.
"""
import datetime
import json
import os
import pathlib
import statistics
import sys
import tempfile
import time
from math import cos, radians, sin

from vtkmodules.vtkCommonCore import vtkLookupTable, vtkMultiThreader, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkImageAppend
from vtkmodules.vtkFiltersModeling import vtkOutlineFilter
from vtkmodules.vtkImagingCore import (vtkImageBlend, vtkImageCast, vtkImageChangeInformation,
                                       vtkImageExtractComponents, vtkImageMapToColors)
from vtkmodules.vtkIOImage import vtkNrrdReader, vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkIONetCDF import vtkNetCDFCFReader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkVolume, vtkWindowToImageFilter)
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws for vtkRenderWindow
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401, shows what was cast

from pages import ROOT, commit, processor, said, table

GALLERY = ROOT / "app/gallery"
README = GALLERY / "README.md"
KEPT = ROOT / "build/beside_vtk"
PROGRAM = ROOT / "build/release/app/isochron"
BEGIN, END = "<!-- beside_vtk.py begins -->", "<!-- beside_vtk.py ends -->"
FIRE = ROOT / "datasets/pool_fire_T.nc"
PIXELS, THREADS, FRAMES = 600, 2, 5
FINEST = 128  # samples a cell at which VTK draws the fire's shell closed
AZIMUTH, ELEVATION = 30, 20
HALF_ANGLE = 15  # degrees, of app/choices/camera.cpp
GROUND = "#0d1117"  # of isochron's pictures
# Name: file, step, title, range, distance in half diagonals, colour, opacity of a cell's length, what is seen.
SCENES = {
    "fire_shell": (FIRE, 14, "Pool fire, 845 to 855 K", (845, 855), 2.4, "#ffb15c", 0.9,
                   "the shell is closed by isochron; by VTK it is full of holes, except where it is seen along its wall"),
    "fire": (FIRE, 14, "Pool fire, 600 to 1000 K", (600, 1000), 3, "#e0562b", 0.2,
             "the same to the eye; faint stripes on VTK's column; the foot reaches lower by isochron (below)"),
    "fire_low": (FIRE, 14, "Pool fire, 320 to 400 K", (320, 400), 3, "#5b9bd5", 0.2, "the same to the eye"),
    "fire_lit": (FIRE, 14, "Pool fire, 600 to 1000 K, lit", (600, 1000), 3, "#e0562b", 0.9, "one surface, the same folds and gleams; darker by VTK"),
    "hurricane": ("isabel_30_raw_f64.vti", None, "Hurricane, 39.5 to 40.5 m/s", (39.5, 40.5), 1.6, "#8fd19e", 0.9,
                  "the wall of the eye is closed by isochron, grainy by VTK"),
    "tooth": ("tooth_u8.nrrd", None, "Tooth, 80 to 90", (80, 90), 3.9, "#e9dcc0", 0.05,
              "the same to the eye, noise and all"),
    "aneurism": ("aneurism_256_u8.vti", None, "Aneurism, 100 to 120", (100, 120), 2.6, "#e86a6a", 0.9,
                 "the same vessels; their walls are grainy by VTK and smooth by isochron"),
}
# Lit by each program's own light from the camera: their gradients and gleams differ.
LIT = {"fire_lit"}


class Scene:
    def __init__(self, name, folder):
        file, self.step, self.title, self.range, self.distance, self.color, self.opacity, self.seen = SCENES[name]
        self.name, self.file, self.is_lit = name, folder / file, name in LIT

    def options(self):
        """What isochron is told. The distance is given, so that no picture depends on how it fits a box."""
        step = [] if self.step is None else ["--step", str(self.step)]
        return [str(self.file), *step, "--range", "{}:{}".format(*self.range), "--color", self.color,
                "--opacity", str(self.opacity), "--opacity-per", "length", "--light", "full" if self.is_lit else "off", "--threads", str(THREADS),
                "--view", f"{AZIMUTH},{ELEVATION},{self.distance}", "--size", f"{PIXELS}x{PIXELS}"]


def isochron_picture(scene, folder):
    out = pathlib.Path(folder) / f"{scene.name}.png"
    said(PROGRAM, "render", *scene.options(), "--model", "cells", "--device", "cpu", "-o", out)
    reader = vtkPNGReader()
    reader.SetFileName(str(out))
    reader.Update()
    return reader.GetOutput()


def isochron_times(scene):
    """Seconds of a frame, and before the first; by depth where it was drawn so, which a single colour needs not."""
    figures = json.loads(said(PROGRAM, "measure", *scene.options(), "--frames", str(FRAMES), "--views", "1",
                               "--rays", "1", "--json"))
    mode = "lit cells" if scene.is_lit else "cells"
    cells = sorted((m for m in figures["modes"] if m["mode"] == mode), key=lambda m: m["order"])[0]
    return cells["frame"], cells["before"]


def read(scene):
    if scene.file.suffix == ".nc":
        reader = vtkNetCDFCFReader()
        reader.SphericalCoordinatesOff()
        reader.SetFileName(str(scene.file))
        reader.UpdateInformation()
        times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
        reader.UpdateTimeStep(times[scene.step])
        image = reader.GetOutputDataObject(0)
        image.GetPointData().SetActiveScalars(image.GetPointData().GetArrayName(0))
        return image
    reader = vtkNrrdReader() if scene.file.suffix == ".nrrd" else vtkXMLImageDataReader()
    reader.SetFileName(str(scene.file))
    reader.Update()
    return reader.GetOutput()


def in_world(image):
    """Scaled as PlacedPoints does: the box's centre at 0 and its corners 1 away. All axes here have one unit."""
    lengths = [(n - 1) * s for n, s in zip(image.GetDimensions(), image.GetSpacing())]
    radius = sum(length**2 for length in lengths)**0.5 / 2
    change = vtkImageChangeInformation()
    change.SetInputData(image)
    change.SetOutputSpacing([s / radius for s in image.GetSpacing()])
    change.SetOutputOrigin([-length / radius / 2 for length in lengths])
    change.Update()
    return change.GetOutput()


def in_floats(image):
    cast = vtkImageCast()
    cast.SetInputData(image)
    cast.SetOutputScalarTypeToFloat()
    cast.Update()
    return cast.GetOutput()


def unit_length(image):
    x, y, z = image.GetSpacing()
    return (x * y * z)**(1 / 3)


def has_bytes(image):
    return image.GetScalarTypeAsString() == "unsigned char"


def table_step(image):
    """Between two entries of the mapper's tables, in the field's unit."""
    lo, hi = image.GetScalarRange()
    return 1 if has_bytes(image) else (hi - lo) / 32767


def volume(scene, image, rounding, mapper):
    """`rounding`: between points isochron takes whole numbers as rounded ones; so do VTK's tables of bytes."""
    lo, hi = scene.range[0] - rounding, scene.range[1] + rounding
    out = table_step(image)
    opacity = vtkPiecewiseFunction()
    for value, y in ((lo - out, 0), (lo, scene.opacity), (hi, scene.opacity), (hi + out, 0)):
        opacity.AddPoint(value, y)
    white = vtkColorTransferFunction()
    white.AddRGBPoint(lo, *(channels(scene.color) if scene.is_lit else (1, 1, 1)))
    mapper.SetInputData(image)
    mapper.SetNumberOfThreads(THREADS)
    drawn = vtkVolume()
    drawn.SetMapper(mapper)
    look = drawn.GetProperty()
    look.SetColor(white)
    look.SetScalarOpacity(opacity)
    look.SetScalarOpacityUnitDistance(unit_length(image))
    look.SetInterpolationTypeToLinear()
    look.SetShade(scene.is_lit)
    return drawn


def look_at(scene, camera):
    """As standOf (app/choices/camera.cpp) with a distance."""
    a, e = radians(AZIMUTH), radians(ELEVATION)
    back = (sin(a) * cos(e), -cos(a) * cos(e), sin(e))
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition([scene.distance * b for b in back])
    camera.SetViewUp(-sin(a) * sin(e), cos(a) * sin(e), cos(e))
    camera.SetViewAngle(2 * HALF_ANGLE)
    camera.SetClippingRange(scene.distance / 200, scene.distance + 10)


def window_of(scene, drawn):
    renderer, window = vtkRenderer(), vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(PIXELS, PIXELS)
    window.AddRenderer(renderer)
    if scene.is_lit:
        renderer.SetBackground(*channels(GROUND))
    renderer.AddVolume(drawn)
    look_at(scene, renderer.GetActiveCamera())
    return window, renderer


def vtk_times(window):
    """Seconds of a frame, and how much longer the first takes."""
    times, busy = [], []
    for _ in range(1 + FRAMES):
        start, worked = time.perf_counter(), time.process_time()
        window.Render()
        times.append(time.perf_counter() - start)
        busy.append((time.process_time() - worked) / times[-1])
    frame = statistics.median(times[1:])
    print(f"VTK had {statistics.median(busy[1:]):.2f} of {THREADS} processors", file=sys.stderr)
    return frame, max(times[0] - frame, 0)


def outline(image):
    box, mapper, actor = vtkOutlineFilter(), vtkPolyDataMapper(), vtkActor()
    box.SetInputData(image)
    mapper.SetInputConnection(box.GetOutputPort())
    actor.SetMapper(mapper)
    return actor


def srgb(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear**(1 / 2.4) - 0.055


def linear(encoded):
    return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055)**2.4


def channels(color):
    return [int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)]


def light(color):
    return [linear(channel) for channel in channels(color)]


def encoded(scene, window):
    """White on black is opacity: of so much the colour's light on isochron's ground, encoded as isochron encodes it.
    What is lit stays as VTK blends it, in encoded colours."""
    ends = list(zip(light(GROUND), light(scene.color)))
    shades = vtkLookupTable()
    shades.SetNumberOfTableValues(256)
    shades.SetRange(0, 255)
    for i in range(256):
        shades.SetTableValue(i, *(srgb(a + i / 255 * (b - a)) for a, b in ends), 1)
    grab, red, mapped = vtkWindowToImageFilter(), vtkImageExtractComponents(), vtkImageMapToColors()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    if scene.is_lit:
        return grab.GetOutput()
    red.SetInputConnection(grab.GetOutputPort())
    red.SetComponents(0)
    mapped.SetInputConnection(red.GetOutputPort())
    mapped.SetLookupTable(shades)
    mapped.SetOutputFormatToRGB()
    mapped.Update()
    return mapped.GetOutput()


def vtk_default(scene, image):
    """As vtkSmartVolumeMapper sets this mapper: two samples a cell, more where cells are few; values as read."""
    mapper = vtkFixedPointVolumeRayCastMapper()
    mapper.LockSampleDistanceToInputSpacingOn()
    window, _ = window_of(scene, volume(scene, image, 0, mapper))
    return vtk_times(window)


def vtk_fine(scene, image, samples=8):
    """Its best: so many samples a cell, a ray a pixel, and floats, whose table is finer than that of bytes."""
    rounding = 0.5 if has_bytes(image) else 0
    image = in_floats(image)
    mapper = vtkFixedPointVolumeRayCastMapper()
    mapper.AutoAdjustSampleDistancesOff()
    mapper.SetImageSampleDistance(1)
    mapper.SetSampleDistance(min(image.GetSpacing()) / samples)
    mapper.SetInteractiveSampleDistance(min(image.GetSpacing()) / samples)
    window, renderer = window_of(scene, volume(scene, image, rounding, mapper))
    times, picture = vtk_times(window), encoded(scene, window)
    renderer.AddActor(outline(image))
    window.Render()
    return times, picture, encoded(scene, window)


def write(image, path):
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(str(path))
    writer.SetCompressionLevel(9)
    writer.Write()


def compose(left, right, path):
    both = vtkImageAppend()
    for picture in (left, right):
        both.AddInputData(picture)
    both.Update()
    write(both.GetOutput(), path)


def overlay(one, other, path):
    blend = vtkImageBlend()
    for picture in (one, other):
        blend.AddInputData(picture)
    blend.SetOpacity(1, 0.5)
    blend.Update()
    write(blend.GetOutput(), path)


def measure(scene):
    print(f"{scene.name} ...", file=sys.stderr)
    about = {"commit": commit("app/gallery"), "date": datetime.date.today().isoformat(), "load": os.getloadavg()[0]}
    image = in_world(read(scene))
    with tempfile.TemporaryDirectory() as folder:
        ours = isochron_picture(scene, folder)
    times = {"isochron": isochron_times(scene), "default": vtk_default(scene, image)}
    times["fine"], theirs, outlined = vtk_fine(scene, image)
    if scene.name == "fire_shell":
        times["finest"] = vtk_fine(scene, image, FINEST)[0]
    compose(ours, theirs, GALLERY / f"beside_vtk_{scene.name}.png")
    KEPT.mkdir(parents=True, exist_ok=True)
    overlay(ours, outlined, KEPT / f"{scene.name}.png")
    (KEPT / f"{scene.name}.json").write_text(json.dumps({"about": about, "times": times}, indent=1))


def kept(name):
    file = KEPT / f"{name}.json"
    return json.loads(file.read_text()) if file.exists() else None


def ms(seconds):
    return f"{1e3 * seconds:.3g}" if seconds < 0.9995 else f"{1e3 * seconds:,.0f}"


def span(values):
    return f"{ms(min(values))} to {ms(max(values))} ms"


def section(measured):
    cpu = processor()
    abouts = [data["about"] for _, data in measured]
    dates = ", ".join(sorted({f"commit {a['commit']}, {a['date']}" for a in abouts}))
    loads = " ".join(f"{a['load']:.1f}" for a in abouts)
    times = {name: data["times"] for name, data in measured}
    rows = [[SCENES[name][2], *(ms(t[key][0]) for key in ("isochron", "default", "fine")), SCENES[name][-1]]
            for name, t in times.items()]
    first = {key: span([t[key][1] for t in times.values()]) for key in ("isochron", "default")}
    finest = "".join(f"With {FINEST} samples a cell VTK's is closed, too, and has the same seams; a frame takes {ms(t['finest'][0])} ms.\n"
                     for t in times.values() if "finest" in t)
    slower = [SCENES[name][2] for name, t in times.items() if t["isochron"][0] > t["default"][0]]
    lost = f"\nBy isochron slower than VTK's default: {'; '.join(slower)}." if slower else ""
    pictures = "\n\n".join(f"![{SCENES[name][2]}](beside_vtk_{name}.png)" for name in times)
    head = ["scene", "isochron, ms", "VTK default, ms", "VTK fine, ms", "what is seen"]
    return f"""## Beside VTK's ray caster

`xvfb-run -a tests/bench/beside_vtk.py FOLDER` makes this section: left isochron, right VTK {vtkVersion.GetVTKVersion()} by
`vtkFixedPointVolumeRayCastMapper`, both on the processor by {THREADS} threads, {PIXELS} x {PIXELS} pixels, from the same camera.
*{cpu}, {dates}, load {loads} at the start of each.*

Where a range is wide for what the field changes in a cell, both draw the same picture, isochron's folds a little softer. The fire's thin
shell has holes by VTK, whose eight samples a cell step over it; isochron takes the length inside the range in each cell and is closed.
{finest}
{table(head, rows)}
A frame's time is the median of {FRAMES}; isochron's by `isochron measure`, without axes and legend, VTK's of `Render()`. What only a
first frame needs is left out: isochron's index of cells and selection took {first['isochron']}, VTK's default {first['default']}.{lost}

Both take the same opacity for the length of a cell (`--opacity-per length`, `ScalarOpacityUnitDistance`), without light (`--light off`)
but where it is said: `--light full`, and `ShadeOn` as VTK sets it, each from the camera; there VTK blends encoded colours, isochron light.
VTK's opacity is a step at each end of the range, as sharp as its tables: 32,768 entries over all values of floats, 256 for bytes.
*Default* is as `vtkSmartVolumeMapper` sets this mapper, two samples a cell and more in small volumes, of the values as read. *Fine*, which
the pictures show, is eight samples a cell; bytes are made floats for it (the tooth is paler without), and ranges of whole numbers
reach half a step farther, as isochron takes them between points. The colour is added to VTK's opacity, of 8 bits, in linear light, as
isochron blends it. VTK's volume ends at the outermost points, isochron's half a cell beyond them.
The ocean of `tests/bench/TRADE.md` is not among them: its levels are uneven, and VTK's ray caster takes no such grid.

{pictures}
"""


def page():
    measured = [(name, data) for name, data in ((name, kept(name)) for name in SCENES) if data]
    if not measured:
        sys.exit("nothing was measured yet")
    before, _, after = README.read_text().partition(BEGIN)
    after = after.partition(END)[2].strip("\n")
    text = f"{before.rstrip()}\n\n{BEGIN}\n{section(measured)}{END}\n"
    README.write_text(text + (f"\n{after}\n" if after else ""))


def main(arguments):
    if not arguments:
        sys.exit(__doc__)
    folder, names = pathlib.Path(arguments[0]).resolve(), arguments[1:]
    if unknown := [name for name in names if name not in SCENES]:
        sys.exit(f"{unknown[0]}: no such scene; there are: {' '.join(SCENES)}")
    vtkMultiThreader.SetGlobalDefaultNumberOfThreads(THREADS)
    for scene in () if arguments[0] == "--page" else [Scene(name, folder) for name in names or SCENES]:
        if scene.file.exists():
            measure(scene)
        else:
            print(f"{scene.name}: {scene.file.name} is not there", file=sys.stderr)
    page()


main(sys.argv[1:])
