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
    return said("sed", "-n", "0,/^model name/s/^model name[^:]*: *//p", "/proc/cpuinfo").strip()


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"
