"""What the pictures of the docs were drawn from (scripts/pictures), for the tests."""
import importlib.machinery
import importlib.util
import os

from pages import SOURCE, check

path = os.path.join(SOURCE, "scripts", "pictures")
loader = importlib.machinery.SourceFileLoader("pictures", path)
pictures = importlib.util.module_from_spec(importlib.util.spec_from_loader("pictures", loader))
loader.exec_module(pictures)
record = pictures.read_record()


def check_drawn(name, numbers, tolerance, kind):
    """Does the picture show these numbers?"""
    found = pictures.differences(record[name]["numbers"], numbers, tolerance)
    check(not found, f"docs/pictures/{name} is stale (scripts/pictures {kind} draws it again):\n" + "\n".join(found[:20]))
