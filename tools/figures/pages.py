"""Compares the pages with the stored figures: their tables between markers, and the orderings that their prose states."""
import os
from pathlib import Path

from figures import claims, orderings, tables
from figures.markers import CODE_SPAN, COMMENT, END, LIKE_A_MARKER, START, fold, is_fence
from figures.prose import DECIMAL, repeated
from figures.spec import Spec, read_spec, spec_path
from figures.stored import FigureError, Store

NOT_SEARCHED = {"build", "data", "node_modules"}


def find_pages(root: Path) -> list[Path]:
    """Every page of the tree, README.md first."""
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if name not in NOT_SEARCHED and not name.startswith("."))
        found += [Path(folder) / name for name in sorted(names) if name.endswith(".md")]
    return sorted(found, key=lambda path: (path.parent != root, path))


def find_specs_without_page(root: Path) -> list[str]:
    specs = {spec_path(page) for page in find_pages(root)}
    folders = {root, *(path.parent for path in specs)}
    stray = sorted({path for folder in folders for path in folder.glob("*.figures.toml")} - specs)
    return [f"{path.relative_to(root)}: there is no page of that name beside it" for path in stray]


class Page:
    """A page with its specification. After `check`, `lines` holds the page with generated tables."""

    def __init__(self, root: Path, path: Path):
        self.path = path
        self.name = str(path.relative_to(root))
        self.spec_name = str(spec_path(path).relative_to(root))
        self.text = path.read_text()
        self.lines = self.text.split("\n")
        self.complaints: list[str] = []
        self.stale: list[str] = []
        self.figures = 0
        self.comparisons = 0

    def check(self, store: Store) -> None:
        """Collects complaints; tables that differ from the stored figures go to `stale`."""
        try:
            spec = read_spec(self.path)
        except FigureError as error:
            self.complaints.append(f"{self.spec_name}: {error}")
            return
        found = self.find_tables()
        self.check_orderings(store, spec)
        printed: set[str] = set()
        titles: set[str] = set()
        for name in (table.name for table in spec.tables if table.name not in found):
            self.complaints.append(f"{self.spec_name}: the page has no table {name!r}")
        by_name = {table.name: (tables.generate, table) for table in spec.tables}
        for claim in spec.claims:
            by_name.setdefault(f"claims_{claim.of}", (claims.generate, []))[1].append(claim)
        for name in by_name.keys() - found.keys() - {table.name for table in spec.tables}:
            self.complaints.append(f"{self.spec_name}: the page has no table {name!r}")
        self.complaints += [f"{self.name}:{number}: {text!r} compares with a paper; put that into a [[claim]] of the page, whose figures "
                            "are compared, or name the setting" for number, text in claims.compare_in_words(self.lines)]
        # From last to first, so that earlier positions stay valid.
        for name, (first, last) in reversed(found.items()):
            if name not in by_name:
                self.complaints.append(f"{self.name}:{first + 1}: {self.spec_name} has no table {name!r}")
                continue
            try:
                make, content = by_name[name]
                generated, figures = make(store, content)
            except FigureError as error:
                self.complaints.append(f"{self.name}:{first + 1}: table {name!r}: {error}")
                continue
            self.figures += figures
            rows = [line.split("|", 2) for line in generated[2:]]
            printed |= set(DECIMAL.findall("\n".join(cells for _, _, cells in rows)))
            titles |= set(DECIMAL.findall("\n".join([generated[0], *(title for _, title, _ in rows)])))
            self.compare_lines(name, first + 1, self.lines[first + 1:last], generated)
            self.lines[first + 1:last] = generated
        # Prose may name a row or a column by the number in its title.
        self.check_repeats(printed - titles, spec.may_repeat)

    def compare_lines(self, name: str, first: int, printed: list[str], generated: list[str]) -> None:
        if printed == generated:
            return
        for number, (line, right) in enumerate(zip(printed, generated)):
            if line != right:
                self.stale.append(f"{self.name}:{first + number + 1}: table {name!r} has\n    {line}\n"
                                  f"  the stored figures give\n    {right}")
                return
        self.stale.append(f"{self.name}:{first}: table {name!r} has {len(printed)} lines, the stored figures give {len(generated)}")

    def find_tables(self) -> dict[str, tuple[int, int]]:
        """The marked tables, with the lines of their two markers. Complains of markers without a partner and of all other comments."""
        found: dict[str, tuple[int, int]] = {}
        started: tuple[str, int] | None = None
        code = False
        for number, line in enumerate(self.lines):
            if is_fence(line):
                code = not code
            if code:
                continue
            place = f"{self.name}:{number + 1}"
            if marker := START.fullmatch(line):
                if started:
                    self.complaints.append(f"{self.name}:{started[1] + 1}: table {started[0]!r} has no line {END}")
                started = (marker.group(1), number)
            elif line == END:
                if not started:
                    self.complaints.append(f"{place}: the table that ends here has no line <!-- table: NAME -->")
                elif between := [line for line in self.lines[started[1] + 1:number] if not line.startswith("|")]:
                    self.complaints.append(f"{place}: between the markers of table {started[0]!r} is a line that is not of a table: "
                                           f"{between[0][:80]!r}")
                elif started[0] in found:
                    self.complaints.append(f"{place}: the page has two tables {started[0]!r}")
                else:
                    found[started[0]] = (started[1], number)
                started = None
            elif LIKE_A_MARKER.search(CODE_SPAN.sub("", line)):
                self.complaints.append(f"{place}: {line.strip()[:80]!r} is not a marker; those are <!-- table: NAME --> and {END}, "
                                       "each alone on its line, and a page has no other comments")
        if started:
            self.complaints.append(f"{self.name}:{started[1] + 1}: table {started[0]!r} has no line {END}")
        return found

    def check_orderings(self, store: Store, spec: Spec) -> None:
        prose = self.prose()
        for ordering in spec.orderings:
            if fold(ordering.says) not in prose:
                self.complaints.append(f"{self.spec_name}: the page does not say {ordering.says!r}")
            try:
                wrong, count = orderings.compare(store, ordering)
            except FigureError as error:
                self.complaints.append(f"{self.spec_name}: ordering {ordering.says!r}: {error}")
                continue
            self.comparisons += count
            self.complaints += [f"{self.name}: {ordering.says!r} does not hold: {text}" for text in wrong]

    def check_repeats(self, printed: set[str], allowed: list[str]) -> None:
        found = repeated(self.text.split("\n"), printed)
        for number, text in found:
            if text not in allowed:
                self.complaints.append(f"{self.name}:{number}: the prose repeats {text} of a table; say which row or column it means. "
                                       f"If it is another number: may_repeat = [\"{text}\"] under [prose] in {self.spec_name}")
        for text in allowed:
            if text not in (repeat for _, repeat in found):
                self.complaints.append(f"{self.spec_name}: may_repeat has {text!r}, but the prose does not repeat it from a table")

    def prose(self) -> str:
        """The page without tables and comments, and with single blanks."""
        return fold(COMMENT.sub("", "\n".join(line for line in self.text.split("\n") if not line.startswith("|"))))

    def write(self) -> bool:
        """Writes the generated tables. Returns whether the page has changed."""
        text = "\n".join(self.lines)
        if text != self.text:
            self.path.write_text(text)
        return text != self.text
