"""The command line of tools/check_figures."""
import argparse
from pathlib import Path

from figures import counts, results
from figures.pages import Page, find_pages, find_specs_without_page
from figures.prose import unpinned
from figures.stored import FigureError, Store

HELP = """\
Compares the figures of pages with the stored ones, and what programs measured with what is stored.

  tools/check_figures                        the tables and orderings of all pages
  tools/check_figures FOLDER [--quick]       also the CSV files in FOLDER (build/papers, by tools/run_papers)
  tools/check_figures FOLDER --speeds        also speeds.csv in FOLDER (build/bench, by tools/run_benchmarks)
  tools/check_figures FOLDER [--quick] --store [NAME...] [--reason TEXT]
                                             stores the files of FOLDER that are stored already, and those named
  tools/check_figures --write                writes the tables of all pages, and the counts
  tools/check_figures --unpinned [PAGE...]   lists numbers of prose that look measured

Exit status: 1 where something differs or is missing, 2 for a wrong command line.
"""
DETAILS = """\
Stored figures are the CSV files that the programs write: lab/experiments/figures/*.csv of the whole experiments on real takes,
lab/experiments/figures/quick/*.csv of their quick forms on takes that the project makes itself. Beside them:

  tolerances.csv   the difference that is allowed: the larger of `absolute` and of `relative` times the stored figure. The line
                   `*` is for files without a line. A speed may be `relative` times as large or as small.
  counts.csv       how many figures each page prints, how many pairs its orderings compare, and the filled cells of each
                   stored file. A different number is an error; --write stores the new one and says so.
  reasons.csv      why figures moved by more than their tolerance; --store asks for it.

A page has its tables between two lines:

  <!-- table: NAME -->
  <!-- end of table -->

The file beside it, PAGE.figures.toml, says what is in them:

  [[table]]
  name = "page_auto"            # as in the marker
  file = "page_auto.csv"        # where the figures are; column, row and cell may name another file
  row_title = "clip"            # title of the first column
  bold = "lowest in row"        # or highest, or in column; equal figures are all bold; leave out for none
  columns = [
    {title = "noisy", print = "{rms_deg:.2f} / {p99_deg:.1f}", where = {way = "noisy"}, bold = false},
    {title = "`auto`", print = "{rms_deg:.2f} / {p99_deg:.1f}", where = {way = "auto"}},
    {title = "remark"},
  ]
  rows = [
    {title = "35_01 walk", where = {take = "35_01"}, cells = {remark = "slow"}},
    {title = "02_05 punch", where = {take = "02_05"}},
  ]

A cell prints the one line of the file that all its filters select: `where` of the table, the row, the column and the cell.
A filter has texts, numbers, or lists of them. `print` has fields:

  {column}          as stored                {column:+.1f}        with a sign
  {column:.2f}      with two digits          {column*1000:.0f}    times 1000
  {column:,.0f}     with commas

`cells` has the cells of a row that differ from their column, by the column's title, or by its `id` if two titles are equal:

  cells = {remark = "slow", noisy = ""}                          texts
  cells = {noisy = {print = "{rms_deg:.3f}"}}                    `print`, `where` or `file` of its own
  cells = {time = [{print = "{ms:.0f} / ", where = {case = "1"}}, {print = "{ms:.0f} ms", where = {case = "2"}}]}    several, joined

A row with format = ".3f" prints all its numbers with three digits. If the table has key = "take", a row without `where` is the
line whose column `take` holds the row's title, and the title alone is a row: rows = ["35_01", "02_05"]. A column or a row with
bold = false is left out when the best figures are chosen.

An ordering that the prose states:

  [[ordering]]
  says = "`wiener` is better than `auto` in every row"     # a verbatim piece of the page's prose
  file = "page_learned.csv"
  value = "mean"                   # the column that is compared
  lower = {method = "wiener"}      # a filter, or a list of them; `column` names another column than `value`
  higher = {method = "auto"}
  for_each = ["noise"]             # optional: the columns that pair the two sides
  where = {noise = ["1 degree", "half"]}     # optional: only these lines
  ties = true                      # optional: the two may be equal

A claim of a paper, in the table <!-- table: claims_NAME -->, of which the first line counts how many hold:

  [[claim]]
  of = "NAME"
  place = "figure 3"
  paper = "Five passes leave the least error."            # what the paper states
  here = "{five:.4f} after five, {least:.4f} at best"      # optional: the values, and
  why = "the least is left by 14 passes"                   # a reason, which a claim that does not hold must have
  holds = "five <= least"          # an expression of the values, min, max, abs, sum, len, all, any, sorted, zip and range
  cannot = "it names no takes"     # in place of `holds`: why the claim is not compared
  [claim.values]
  five = {file = "courty_mse.csv", column = "mse", where = {passes = 5}}
  least = {file = "courty_mse.csv", column = "mse", take = "min"}      # of all lines that `where` selects: min, max, mean or list

Prose that compares with a paper in words ("as in the paper") is an error: a claim says it.

Prose must not repeat a figure of a table on its page: a number with a decimal point and three significant digits that both have
is an error. If the number is not that figure but a setting, or a paper's figure, allow it:

  [prose]
  may_repeat = ["1.25"]
"""


def check_pages(store: Store, write: bool) -> list[str]:
    """Returns the complaints about all pages. Writes their tables and the counts first if `write` is set."""
    pages = [Page(store.root, path) for path in find_pages(store.root)]
    complaints = find_specs_without_page(store.root)
    for page in pages:
        page.check(store)
        complaints += page.complaints
        if write:
            if page.write():
                print(f"wrote the tables of {page.name}")
        else:
            complaints += page.stale
    figures, pairs = sum(page.figures for page in pages), sum(page.comparisons for page in pages)
    print(f"{figures} figures of pages and {pairs} pairs of orderings compared")
    if unused := store.unused():
        print(f"Stored, but on no page and in no ordering: {', '.join(unused)}")
    found = counts.count(store, pages)
    stored = counts.read_counts(store)
    changes = counts.differences(stored, found)
    # Other complaints may be about missing figures, which must not become the new count.
    if write and changes and not complaints:
        counts.write_counts(store, found)
        print("\n".join(["wrote counts.csv:", *changes]) if stored else "wrote counts.csv, which was not there")
    elif not stored:
        complaints.append("lab/experiments/figures/counts.csv is missing or empty")
    else:
        complaints += changes
    return complaints


def parse_arguments(words: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=HELP, epilog=DETAILS, usage=argparse.SUPPRESS, prog="check_figures",
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="*", type=Path, metavar="FOLDER [NAME...]")
    parser.add_argument("--quick", action="store_true", help="the results are those of quick forms")
    parser.add_argument("--speeds", action="store_true", help="the results are speeds")
    parser.add_argument("--store", action="store_true", help="store the results")
    parser.add_argument("--reason", default="", help="why figures moved; kept in reasons.csv")
    parser.add_argument("--write", action="store_true", help="write tables and counts")
    parser.add_argument("--unpinned", action="store_true", help="list numbers of prose that look measured")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[2], help="the tree; default: the one of this program")
    arguments = parser.parse_intermixed_args(words)
    if (arguments.store or arguments.quick or arguments.speeds) and not arguments.paths:
        parser.error("name the FOLDER with the results")
    if arguments.write and arguments.paths:
        parser.error("--write takes no FOLDER: store its results first, with --store")
    if arguments.reason and not arguments.store:
        parser.error("--reason belongs to --store")
    if len(arguments.paths) > 1 and not (arguments.store or arguments.unpinned):
        parser.error("only --store and --unpinned take several names")
    return arguments


def run(arguments: argparse.Namespace) -> int:
    root = arguments.root.resolve()
    store = Store(root)
    if arguments.unpinned:
        for path in [path.resolve() for path in arguments.paths] or find_pages(root):
            for line in unpinned(path.read_text().split("\n")):
                print(f"{path.relative_to(root)}:{line}")
        return 0
    if arguments.store:
        names = [str(path) for path in arguments.paths[1:]]
        return results.store_results(store, arguments.paths[0], arguments.quick, names, arguments.reason)
    complaints = check_pages(store, arguments.write)
    print("\n".join(complaints), end="\n" if complaints else "")
    if complaints:
        print("counts.csv was not written; repair these first" if arguments.write else
              "Where the stored figures are right, write tables and counts: tools/check_figures --write")
    for folder in arguments.paths:
        moved, count = (results.compare_speeds(store, folder) if arguments.speeds
                        else results.compare_results(store, folder, arguments.quick))
        complaints += moved
        print("\n".join([f"{count} measured figures compared with the stored ones", *moved]))
        if moved:
            print(f"Where the new figures are right, store them: tools/check_figures {folder} --store --reason \"...\"")
    return 1 if complaints else 0


def main(words: list[str]) -> int:
    """Runs the command with the words behind its name; returns the exit status."""
    try:
        return run(parse_arguments(words))
    except (FigureError, OSError) as error:
        print(error)
        return 1
