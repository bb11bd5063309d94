#!/usr/bin/env python3
"""Checks the direction of includes between the rooms of src/ and lab/, that programs see the public headers only, that what is of one system stands in
src/base/platform and cli/platform, and that rooms call functions of mathematics that are the same on every system (src/base/portable.hpp).

Usage: check_includes.py [ROOT]    exit status 1 and a line for each include that breaks a rule.
"""
import pathlib
import re
import sys

# The rooms that each room may include; the closure is computed below.
USES = {
    "base": set(),
    "motion": {"base"},
    "io": {"motion"},
    "body": {"motion"},
    "signal": {"base"},
    "nn": {"base"},
    "metrics": {"motion", "signal"},
    "fill": {"motion", "signal"},
    "feet": {"motion", "metrics", "models"},
    "cleaner": {"fill", "body", "metrics"},
    "models": {"body", "nn"},
    "methods/auto": {"cleaner"},
    "methods/prior": {"methods/auto", "models"},
    "methods/wiener": {"methods/prior"},
    "methods/learned": {"methods/prior"},
    "classic": {"methods/prior"},
    "papers/courty2008_bilateral": {"cleaner"},
    "papers/lou2010_example": {"methods/prior"},
    "papers/xiao2015_sparse": {"methods/prior"},
    "papers/dean2016_nonlocal": {"cleaner"},
    "papers/mall2017_recurrent": {"methods/prior"},
    "registry": {"methods/wiener", "methods/learned", "classic", "papers/courty2008_bilateral", "papers/lou2010_example",
                 "papers/xiao2015_sparse", "papers/dean2016_nonlocal", "papers/mall2017_recurrent"},
    "check": {"methods/learned", "feet"},
    "clean": {"check"},
    "report": {"clean"},
    "live": {"io", "clean", "registry"},
    "all": {"report", "live"},  # the header that includes the stable ones
    "lab/damage": {"motion"},
    "lab/synthesis": {"motion"},
    "lab/training": {"registry"},
    "lab/samples": {"lab/training", "lab/damage", "methods/learned", "clean"},
}

# The room of every public header.
PUBLIC = {header: room for room, headers in {
    "base": "error options text system random frames",
    "motion": "rotation take take_view motion",
    "io": "io",
    "body": "body",
    "signal": "signal",
    "nn": "tensor",
    "metrics": "metrics figures",
    "fill": "fill gap_plan",
    "feet": "feet normalise",
    "cleaner": "cleaner methods method_options",
    "models": "model",
    "clean": "clean live",
    "check": "check",
    "report": "report pages",
    "live": "sessions",
    "all": "kinemend",
    "lab/damage": "corrupt",
    "lab/synthesis": "synth",
    "lab/training": "train",
}.items() for header in headers.split()}

# The headers of extend/ that are the contract of a cleaning method: they stay as those beside extend/ do.
CONTRACT = {"cleaner", "options", "rotation", "take_view"}

# Folders of programs, which may include only public headers and their own folder.
PROGRAMS = ["cli", "examples", "tools", "python", "web"]

# Functions of <cmath> that systems round differently, and the files that may call them: Eigen computes the exponential
# of a matrix.
SYSTEM_MATHS = re.compile(r"\bstd::(a?(?:sin|cos|tan)h?|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|[lt]gamma|erfc?|polar|arg)\(")
MAY_CALL_SYSTEM_MATHS = {"src/classic/linear_dynamics.cpp"}

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)

# Headers available on every system: the standard library and the project's libraries.
SYSTEM_INCLUDE = re.compile(r"^\s*#\s*include\s*<([^>]+)>", re.MULTILINE)
ON_EVERY_SYSTEM = re.compile(r"[a-z_]+|(unsupported/)?Eigen/\w+|Spectra/.*|(fmt|hwy|fast_float|torch)/.*\.h|toml\+\+/toml\.h|"
                             r"(nlohmann|CLI)/\w+\.hpp|zlib\.h|xxhash\.h")
# Files with a variant for systems without the header, or compiled on one system only.
OF_ONE_SYSTEM = {"src/base/parallel.cpp": "tbb/", "src/io/text/number.hpp": "emmintrin.h", "wasm/": "emscripten.h"}
PLATFORM = ("src/base/platform/", "cli/platform/")
PORTABLE = ["include", "src", "lab/include", "lab/damage", "lab/synthesis", "lab/samples", "lab/training", "cli", "examples", "tools", "wasm"]

# Names that some systems add to standard headers, by header.
EXTENSIONS = re.compile(r"(?<![\w.>:])(?:::)?(?:" + "|".join([
    # <cstdlib>, <cstdio>
    r"(?:secure_getenv|setenv|unsetenv|putenv|mkstemp|mkostemp|mkdtemp|realpath|qsort_r|reallocarray|aligned_alloc)\s*\(",
    r"(?:fileno|fdopen|popen|pclose|getline|getdelim|asprintf|vasprintf|dprintf|fmemopen|open_memstream|fseeko|ftello)\s*\(",
    # <cstring>
    r"(?:memmem|mempcpy|memrchr|rawmemchr|strcasestr|strchrnul|strdup|strndup|strerror_r|stpcpy|strsep|strcasecmp|strncasecmp)\s*\(",
    # <cmath>, <ctime>
    r"(?:sincos|exp10|pow10|lgamma_r|localtime_r|gmtime_r|timegm|strptime|clock_gettime|nanosleep)\s*\(",
    # Names and macros.
    r"(?:ssize_t|off_t|pid_t|environ|program_invocation_\w+|M_PI|_GNU_SOURCE|__GLIBC__|__linux__|__gnu_cxx|__attribute__)\b",
    r"__builtin_(?!bit_cast)",
]) + r")|/proc/self")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def closure(room):
    seen, todo = set(), [room]
    while todo:
        current = todo.pop()
        if current not in seen:
            seen.add(current)
            todo.extend(USES[current])
    return seen


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".cpp", ".hpp", ".h"})


def room_of_include(name):
    """The room an include belongs to; None for a file of the includer's own folder."""
    parts = pathlib.PurePosixPath(name).parts
    if parts[0] == "kinemend":
        return PUBLIC.get(pathlib.PurePosixPath(parts[-1]).stem, "unknown")
    return next((room for room in ("/".join(parts[:2]), parts[0]) if len(parts) > 1 and room in USES), None)


def folder_of(root, room):
    return root / room if room.startswith("lab/") else root / "src" / room


def stands_apart(name, what):
    return any(name.startswith(place) and what.startswith(allowed) for place, allowed in OF_ONE_SYSTEM.items())


def check_systems(root):
    """A line for each header, function and name of one system outside the folders that are for them."""
    problems = []
    for path in (path for folder in PORTABLE for path in sources(root / folder)):
        name = path.relative_to(root).as_posix()
        if name.startswith(PLATFORM):
            continue
        text = path.read_text()
        problems += [f"{name}: <{header}> is not on every system; what needs it stands in {' or '.join(PLATFORM)}"
                     for header in SYSTEM_INCLUDE.findall(text)
                     if not ON_EVERY_SYSTEM.fullmatch(header) and not stands_apart(name, header)]
        problems += [f"{name}: {found.group().strip(' (')} is not on every system; what needs it stands in {' or '.join(PLATFORM)}"
                     for found in EXTENSIONS.finditer(COMMENT.sub("", text))]
    return problems


def check(root):
    problems = check_systems(root)
    public = sources(root / "include") + sources(root / "lab/include")
    for header in public:
        if header.stem not in PUBLIC:
            problems.append(f"{header.relative_to(root)}: no room is named for this public header")
        beyond = re.findall(r"extend/(\w+)", "".join(INCLUDE.findall(header.read_text())))
        if header.parent.name == "kinemend" and set(beyond) - CONTRACT:
            problems.append(f"{header.relative_to(root)}: what stays may include of extend/ only {', '.join(sorted(CONTRACT))}")
    for room in USES:
        allowed = closure(room)
        files = sources(folder_of(root, room)) + [header for header in public if PUBLIC.get(header.stem) == room]
        for path in files:
            for name in INCLUDE.findall(path.read_text()):
                other = room_of_include(name)
                if other is not None and other not in allowed:
                    problems.append(f"{path.relative_to(root)}: room {room} may not include {name} (room {other})")
    for folder in PROGRAMS:
        for path in sources(root / folder):
            for name in INCLUDE.findall(path.read_text()):
                own = (path.parent / name).exists() or (root / folder / name).exists()
                if not name.startswith("kinemend/") and not own:
                    problems.append(f"{path.relative_to(root)}: a program sees public headers only, not {name}")
    return problems


def check_maths(root):
    problems = []
    rooms = sources(root / "src") + [path for room in USES if room.startswith("lab/") for path in sources(root / room)]
    for path in rooms:
        name = str(path.relative_to(root))
        if name not in MAY_CALL_SYSTEM_MATHS:
            called = sorted(set(SYSTEM_MATHS.findall(path.read_text())))
            problems += [f"{name}: std::{function} differs by system; use portable::{function}" for function in called]
    return problems


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    folders = {path.parent.relative_to(root / "src") for path in sources(root / "src")}
    missing = sorted(str(folder) for folder in folders if not {str(folder), *map(str, folder.parents)} & set(USES))
    problems = [f"src/{name}: no rule for this room" for name in missing] + check(root) + check_maths(root)
    print("\n".join(problems) if problems else "includes: every room looks the right way")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
