#!/usr/bin/env python3
"""Breaks the code one operator, constant, branch or statement at a time and lists what no test notices.

    tests/mutate.py [--build build/release] [--only REGEX] [--line N] [--jobs N] [FILE...]

The build folder holds a built pure_tests; nothing is written there or in the tree. A mutant is compiled
alone, without optimisation, and linked with the test files that concern it. It is killed by a test that
fails, a crash, or a run of three times as long as without it. What survives is printed with its
line; what cannot be told apart from the code as it is stands in mutate_equivalent.txt, with the reason.
Not part of CI: all files take an hour or two on a core of their own; --every N tries a sample.
"""
import argparse
import concurrent.futures
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# What is broken: the sources that hold the code when it is a header, and the tests that concern it.
SUBJECTS = {
    "timeseries/index/range_set.cpp": ([], ["timeseries/range_set", "timeseries/range_set_rounding",
                                            "timeseries/range_text"]),
    "timeseries/index/sorted_step.cpp": ([], ["timeseries/sorted_step"]),
    "timeseries/series/time_cursor.cpp": ([], ["timeseries/time_cursor", "timeseries/playback"]),
    "render/splat/depth_order.cpp": ([], ["render/depth_order"]),
    "render/model/footprint.h": (["render/reference/cpu_splatter.cpp"],
                           ["render/cpu_splatter", "render/footprint"]),
    "timeseries/readers/cf/cf_axes.cpp": ([], ["timeseries/netcdf_axes", "timeseries/netcdf_reader"]),
    "timeseries/readers/cf/cf_grid.cpp": ([], ["timeseries/netcdf_axes", "timeseries/netcdf_reader"]),
    "timeseries/readers/cf/cf_packing.cpp": ([], ["timeseries/cf_packing", "timeseries/netcdf_reader"]),
    "timeseries/readers/cf/cf_time.cpp": ([], ["timeseries/netcdf_time", "timeseries/time_units",
                                            "timeseries/calendar"]),
}

SWAPS = [(" < ", [" <= ", " >= "]), (" > ", [" >= ", " <= "]), (" <= ", [" < ", " > "]),
         (" >= ", [" > ", " < "]), (" == ", [" != "]), (" != ", [" == "]),
         (" && ", [" || "]), (" || ", [" && "]), (" + ", [" - "]), (" - ", [" + "]),
         (" * ", [" / "]), (" / ", [" * "]), (" += ", [" -= "]), (" -= ", [" += "]),
         ("++", ["--"]), ("--", ["++"]), ("true", ["false"]), ("false", ["true"]),
         ("std::min(", ["std::max("]), ("std::max(", ["std::min("]),
         ("std::floor(", ["std::ceil("]), ("std::ceil(", ["std::floor("]),
         ("lower_bound(", ["upper_bound("]), ("upper_bound(", ["lower_bound("]),
         (".front()", [".back()"]), (".back()", [".front()"]),
         (" ? ", [" || true ? ", " && false ? "]), ("continue;", [";", "break;"]),
         ("break;", [";"])]


def code_mask(text):
    """1 where a character is code: no comment, no text between quotes, no preprocessor line."""
    mask = bytearray(b"\1" * len(text))
    quoted = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"
                        r"|^[ \t]*#[^\n]*|\bassert\([^;]*;", re.S | re.M)
    for m in quoted.finditer(text):
        mask[m.start():m.end()] = b"\0" * (m.end() - m.start())
    return mask


def closing(text, mask, at):
    depth = 0
    for i in range(at, len(text)):
        if mask[i] and text[i] in "([{":
            depth += 1
        if mask[i] and text[i] in ")]}":
            depth -= 1
            if depth == 0:
                return i
    return -1


def mutants(text):
    """(from, to, replacement) of each, in the order of the text."""
    mask = code_mask(text)
    found = []

    def change(start, end, by):
        if all(mask[start:end]):
            found.append((start, end, by))

    for old, news in SWAPS:
        pattern = r"(?<![\w:])" + old + r"(?!\w)" if old.isalpha() else re.escape(old)
        for m in re.finditer(pattern, text):
            for new in news:
                change(m.start(), m.end(), new)
    for m in re.finditer(r"(?<![\w.])(\d[\d']*)(\.\d*)?([eE][-+]?\d+)?[fuUlL]*(?![\w.])", text):
        if m.group(2) or m.group(3):
            change(m.start(), m.end(), "(%s * 1.25 + 0.01)" % m.group(0))
        else:
            change(m.start(), m.end(), "(%s + 1)" % m.group(0))
            if m.group(0) != "0":
                change(m.start(), m.end(), "(%s - 1)" % m.group(0))
    for m in re.finditer(r"(?<=[( ])!(?=[\w(])", text):
        change(m.start(), m.end(), "")
    for m in re.finditer(r"\b(if|while) (?:constexpr )?\(", text):
        end = closing(text, mask, m.end() - 1)
        if end < 0 or not mask[m.start()] or ";" in text[m.end():end]:
            continue
        inside = text[m.end():end]
        found.append((m.end(), end, "false && (%s)" % inside))
        if m.group(1) == "if":
            found.append((m.end(), end, "true || (%s)" % inside))
    # A statement: what stands between its first character and its semicolon, on its own.
    for m in re.finditer(r"(?<=[;{})])\s*\n[ ]+(?=[\w*+-])", text):
        start, i, depth = m.end(), m.end(), 0
        while i < len(text) and not (mask[i] and text[i] == ";" and depth == 0):
            depth += (mask[i] and text[i] in "([{") - (mask[i] and text[i] in ")]}")
            if depth < 0:
                break
            i += 1
        statement = text[start:i]
        if depth == 0 and mask[start] and not re.match(
                r"(return|using|case|default|if|for|while|else|do|namespace|struct|class|enum|static|"
                r"template|public|private|break|continue|switch|const|constexpr|auto)\b", statement):
            found.append((start, i, ""))
    return sorted(set(found))


class Builder:
    """Compiles and links as the build folder does, but for the mutant."""

    def __init__(self, build, work):
        self.build, self.work = os.path.abspath(build), work
        with open(os.path.join(build, "compile_commands.json")) as f:
            self.commands = {os.path.relpath(c["file"], ROOT): c for c in json.load(f)}
        links = subprocess.run(["ninja", "-C", build, "-t", "commands", "pure_tests"], check=True,
                               capture_output=True, text=True).stdout.splitlines()
        link = next(line for line in reversed(links) if " -o tests/pure_tests " in line)
        self.link = shlex.split(link.split("&&")[1] if "&&" in link else link)

    def compiler(self, source):
        words = shlex.split(self.commands[source]["command"])
        if "ccache" in words[0]:
            words = words[1:]
        keep, skip = [], False
        for word in words:
            if skip:
                skip = False
            elif word in ("-o", "-c", "-MF", "-MT"):
                skip = True
            elif word not in ("-MD", "-Werror", "-O3", "-O2", "-DNDEBUG") and not word.startswith("-W"):
                keep.append(word)
        return keep + ["-O0", "-w", "-fno-diagnostics-color"]

    def run(self, command):
        return subprocess.run(command, cwd=self.build, capture_output=True, text=True)

    def prefix(self, source, name):
        """What a source includes, compiled once: most of the time goes there."""
        with open(os.path.join(ROOT, source)) as f:
            lines = [l for l in f.read().splitlines() if l.startswith("#include")]
        header = os.path.join(self.work, name + "_prefix.h")
        with open(header, "w") as f:
            f.write("\n".join(lines) + "\n")
        self.run(self.compiler(source) + ["-x", "c++-header", header, "-o", header + ".gch"])
        return header

    def compile(self, source, text_file, out, extra):
        return self.run(self.compiler(source) + extra + ["-c", text_file, "-o", out]).returncode == 0

    def program(self, objects, tests, out):
        words, placed = [], False
        for word in self.link:
            if word.endswith("_test.cpp.o"):
                # Mutants first: of an inline function the linker takes the first copy.
                if not placed:
                    words += objects
                    words += ["tests/CMakeFiles/pure_tests.dir/%s_test.cpp.o" % test for test in tests]
                placed = True
            elif word == "tests/pure_tests":
                words.append(out)
            else:
                words.append(word)
        if words and "ccache" in words[0]:
            words = words[1:]
        return self.run(words)


# Tests that take long, the longest last: run only for mutants that those before let live.
SLOW, SLOWEST = "*Random*:*AUnion*", "*Awkward*:*Large*"
TURNS = ["-%s:%s" % (SLOW, SLOWEST), "%s-%s" % (SLOW, SLOWEST), SLOWEST]


class Limits:
    """How long the tests took without a mutant; three times that is the end."""

    def __init__(self):
        self.seconds = {}

    def passes(self, program, folder):
        return all(self.run(program, folder, tests) for tests in TURNS)

    def run(self, program, folder, tests):
        begun = time.monotonic()
        try:
            code = subprocess.run([program, "--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=" + tests],
                                  cwd=folder, timeout=self.seconds.get(tests, 300),
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  env=dict(os.environ, TMPDIR=folder)).returncode
        except subprocess.TimeoutExpired:
            return False
        self.seconds.setdefault(tests, max(5.0, 3 * (time.monotonic() - begun)))
        return code == 0


def known(path):
    """(file, line's text, replacement) -> reason."""
    reasons = {}
    if os.path.exists(path):
        for line in open(path, encoding="utf-8"):
            if line.strip() and not line.startswith("#"):
                file, was, now, why = [part.strip().replace("\\|", "|") for part in line.split(" | ")]
                reasons[file, was, now] = why
    return reasons


def mutate(subject, args, work, reasons):
    sources, tests = SUBJECTS[subject]
    header = bool(sources)
    sources = sources or [subject]
    builder = Builder(args.build, work)
    text = open(os.path.join(ROOT, subject), encoding="utf-8").read()
    name = subject.replace("/", "_")
    prefixes = {} if header else {s: builder.prefix(s, name) for s in sources}
    limits = Limits()

    def attempt(number, mutated):
        folder = os.path.join(work, "%s_%d" % (name, number))
        os.makedirs(folder)
        try:
            if header:
                overlay = os.path.join(folder, os.path.dirname(subject))
                os.makedirs(overlay)
                with open(os.path.join(folder, subject), "w", encoding="utf-8") as f:
                    f.write(mutated)
                compiled = [(s, os.path.join(ROOT, s), ["-iquote", folder]) for s in sources]
            else:
                path = os.path.join(folder, os.path.basename(subject))
                with open(path, "w", encoding="utf-8") as f:
                    f.write(mutated)
                compiled = [(subject, path, ["-include", prefixes[subject]])]
            objects = []
            for i, (source, path, extra) in enumerate(compiled):
                objects.append(os.path.join(folder, "%d.o" % i))
                if not builder.compile(source, path, objects[-1], extra):
                    return None
            program = os.path.join(folder, "program")
            linked = builder.program(objects, tests, program)
            if linked.returncode != 0:
                sys.exit(linked.stderr[-2000:])
            return limits.passes(program, folder)
        finally:
            shutil.rmtree(folder)

    if not attempt(0, text):
        sys.exit("%s: its tests fail, or it does not compile, without any mutant" % subject)
    todo = []
    for start, end, by in mutants(text):
        line = text.count("\n", 0, start) + 1
        shown = " ".join(text[text.rfind("\n", 0, start) + 1:text.find("\n", end)].split())
        change = "%s -> %s" % (" ".join(text[start:end].split()), " ".join(by.split()) or "nothing")
        if (args.line and line != args.line) or not re.search(args.only, shown):
            continue
        todo.append((line, shown, change, text[:start] + by + text[end:]))
    todo = todo[::args.every]
    counts = {"killed": 0, "survived": 0, "equivalent": 0, "not compiled": 0}
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        jobs = [pool.submit(attempt, i + 1, t[3]) for i, t in enumerate(todo)]
        for (line, shown, change, _), job in zip(todo, jobs):
            result = job.result()
            if result is None:
                counts["not compiled"] += 1
            elif not result:
                counts["killed"] += 1
            elif (subject, shown, change) in reasons:
                counts["equivalent"] += 1
            else:
                counts["survived"] += 1
                print("%s:%d | %s | %s" % (subject, line, shown, change), flush=True)
    print("%s: %s" % (subject, ", ".join("%d %s" % (n, what) for what, n in counts.items())), flush=True)
    return counts["survived"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--build", default=os.path.join(ROOT, "build/release"))
    parser.add_argument("--only", default="", help="lines that match")
    parser.add_argument("--line", type=int, help="this line")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="a sample: every N-th")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("files", nargs="*", metavar="FILE", help="of: " + ", ".join(SUBJECTS))
    args = parser.parse_args()
    reasons = known(os.path.join(ROOT, "tests/mutate_equivalent.txt"))
    work = tempfile.mkdtemp(prefix="mutate")
    try:
        left = sum(mutate(f, args, work, reasons) for f in args.files or SUBJECTS)
    finally:
        shutil.rmtree(work)
    sys.exit(1 if left else 0)


if __name__ == "__main__":
    main()
