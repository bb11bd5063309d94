"""Comments without a subject, and phrases that readers stumble over, are found; others are not."""
import importlib.util
import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("check_comments", ROOT / "tools" / "check_comments.py")
check_comments = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check_comments)


def lines_of(text):
    return [number for number, _ in check_comments.faults(text)]


class CommentsWithoutASubject(unittest.TestCase):
    def test_are_found_at_the_beginning_and_after_a_full_stop(self):
        self.assertEqual(lines_of("// Of each joint.\nint a;\n/// What is left.\nint b;\n"), [1, 3])
        self.assertEqual(lines_of("int a;  // Those that count.\n// It ends. That\n// goes on.\n"), [1, 2])

    def test_are_not_seen_in_the_middle_of_a_sentence_or_in_code(self):
        self.assertEqual(lines_of("// The filter says\n// What it did, and\n// of whom.\nconst char* a = \"// Of text\";\n"), [])

    def test_include_phrases_that_are_no_plain_english(self):
        self.assertEqual(lines_of("// A rate that is none.\nint a;\n// No rate is stated.\n"), [1])


if __name__ == "__main__":
    unittest.main()
