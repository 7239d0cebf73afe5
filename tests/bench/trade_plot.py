"""Error against time as an SVG, of figures as `isochron measure --json` or a table of TRADE.md has them."""
import html
import math

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 720, 480, 84, 640, 60, 412
POINTS, CELLS, LIT = "#0969da", "#c2410c", "#9a6700"


def decades(values):
    logs = [math.log10(v) for v in values if v > 0] or [0]
    first, last = math.floor(min(logs) + 1e-9), math.ceil(max(logs) - 1e-9)
    return first, max(last, first + 1)


def time(decade):
    return f"{10 ** decade:g} s" if decade >= 0 else f"{10 ** (decade + 3):g} ms"


def color(mode):
    return LIT if mode["mode"].startswith("lit") else CELLS if mode["mode"] == "cells" else POINTS


def text(x, y, what, anchor="start", fill="#24292f", size=12):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{fill}" font-size="{size}">{html.escape(what)}</text>'


def line(a, b, stroke, more=""):
    return f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{stroke}"{more}/>'


def svg(title, modes):
    """Modes by depth are filled and joined, mixed ones dashed; hollow: the mass is more than 5 % off."""
    x0, x1 = decades([m["frame"] for m in modes])
    y0, y1 = decades([m["depthError"] for m in modes])
    at = lambda m: (LEFT + (RIGHT - LEFT) * (math.log10(m["frame"]) - x0) / (x1 - x0),
                    BOTTOM - (BOTTOM - TOP) * (math.log10(max(m["depthError"], 10 ** y0)) - y0) / (y1 - y0))
    parts = [f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>', text(LEFT, 30, title, size=16)]
    for d in range(x0, x1 + 1):
        x = at({"frame": 10 ** d, "depthError": 1})[0]
        parts += [line((x, TOP), (x, BOTTOM), "#d0d7de"), text(x, BOTTOM + 20, time(d), "middle", "#57606a")]
    for d in range(y0, y1 + 1):
        y = at({"frame": 1, "depthError": 10 ** d})[1]
        parts += [line((LEFT, y), (RIGHT, y), "#d0d7de"), text(LEFT - 8, y + 4, f"{100 * 10 ** d:g} %", "end", "#57606a")]
    parts += [text((LEFT + RIGHT) / 2, BOTTOM + 44, "time of a frame", "middle", size=13),
              text(LEFT, TOP - 10, "error of optical depth (relative L2)", size=13)]
    for a, b in zip(modes, modes[1:]):
        if color(a) == color(b) == POINTS and a["order"] == b["order"]:
            dashes = ' stroke-dasharray="4 3"' if a["order"] == "mixed" else ""
            parts.append(line(at(a), at(b), POINTS, f' stroke-width="1.5"{dashes}'))
    ordered, taken = any(m["order"] != "mixed" for m in modes), []
    for m in modes:
        x, y = at(m)
        what = f"{m['mode']}, {m['order']}: {1e3 * m['frame']:.3g} ms, error {m['depthError']:.3g}, mass {100 * (m['mass'] - 1):+.1f} %"
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{"#ffffff" if m["massIsOff"] else color(m)}" '
                     f'stroke="{color(m)}" stroke-width="2"><title>{html.escape(what)}</title></circle>')
        if ordered and m["order"] == "mixed":
            continue  # named by those in order
        while any(abs(x - a) < 70 and abs(y - b) < 13 for a, b in taken):
            y += 13
        taken.append((x, y))
        parts.append(text(x + 10, y + 4, m["mode"].removeprefix("points ") if "/" in m["mode"] else m["mode"], fill=color(m)))
    if any(m["massIsOff"] for m in modes):
        parts.append(text(RIGHT, HEIGHT - 10, "hollow: its mass is more than 5 % off; dashed: colours mixed", "end", "#57606a"))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" '
            f'font-family="Inter, sans-serif">\n' + "\n".join(parts) + "\n</svg>\n")
