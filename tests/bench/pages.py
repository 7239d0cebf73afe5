"""What the scripts that write pages of figures have in common."""
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def said(*command):
    return subprocess.run(command, cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout


def commit(*written):
    """The one that is measured; `written` are files and folders whose changes do not matter."""
    changed = said("git", "status", "--porcelain", "--", ".", *(f":!{path}" for path in written)).strip()
    return said("git", "rev-parse", "--short", "HEAD").strip() + (" and changes" if changed else "")


def processor():
    """With the widest vectors that it has, which names alike do not tell."""
    about = pathlib.Path("/proc/cpuinfo").read_text()
    name = next(line.split(":", 1)[1].strip() for line in about.splitlines() if line.startswith("model name"))
    vectors = {"avx512f": "AVX-512", "avx2": "AVX2", "sse4_1": "SSE4"}
    return name + next((f" with {said}" for flag, said in vectors.items() if f" {flag} " in about), "")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"
