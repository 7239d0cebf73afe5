"""What the scripts that write pages of figures have in common."""
import mmap
import pathlib
import subprocess
import time

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


def new_page():
    """Microseconds until a page of 4 KiB is there when it is first written: 0.2 to 0.5, in a virtual machine up to a hundred times as long."""
    size = 64 << 20
    with mmap.mmap(-1, size, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS) as memory:
        memory.madvise(mmap.MADV_NOHUGEPAGE)
        times = []
        for _ in range(2):  # once more, for what Python takes
            begin = time.perf_counter()
            for page in range(0, size, 4096):
                memory[page] = 1
            times.append(time.perf_counter() - begin)
    return 1e6 * (times[0] - times[1]) / (size // 4096)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"
