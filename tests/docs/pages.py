"""The pages of the docs, for the tests of this folder."""
import glob
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import SOURCE, check, new_folder, run  # noqa: E402,F401

# What the program still says, and the pages no longer do: an entry goes when its word is renamed.
RENAMED = {}

PAGES = [os.path.join(SOURCE, name) for name in ("README.md", "CHANGELOG.md", "cases/README.md")] + sorted(
    glob.glob(os.path.join(SOURCE, "docs", "*.md")) + glob.glob(os.path.join(SOURCE, "cases", "*", "README.md")))


def read(*path):
    with open(os.path.join(SOURCE, *path), encoding="utf-8") as stream:
        return stream.read()


def code_of(text):
    """What stands in code blocks and between backticks, as one text."""
    text = text.replace("\\|", "|")  # as it is written in tables
    blocks = re.findall(r"^```.*?^```", text, re.M | re.S)
    return "\n".join(blocks + re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)))


def blocks_of(text, language):
    return [block for word, block in re.findall(r"^```(\w*)\n(.*?)^```", text, re.M | re.S) if word == language]


def has_word(code, word):
    return re.search(rf"(?<![\w-]){re.escape(RENAMED.get(word, word))}(?![\w-])", code) is not None
