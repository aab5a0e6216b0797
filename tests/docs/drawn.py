"""What the pictures of the docs were drawn from (scripts/pictures), for the tests."""
import importlib.machinery
import importlib.util
import os

from pages import SOURCE, check


def load_script(name):
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(SOURCE, "scripts", name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


pictures = load_script("pictures")
record = pictures.read_record()


def check_drawn(name, numbers, tolerance, kind):
    """Does the picture show these numbers?"""
    found = pictures.differences(record[name]["numbers"], numbers, tolerance)
    check(not found, f"docs/pictures/{name} is stale (scripts/pictures {kind} draws it again):\n" + "\n".join(found[:20]))
