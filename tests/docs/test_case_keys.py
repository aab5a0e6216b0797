"""Every key and word that the reader of case files knows stands in docs/case.md; and every key there is known."""
import glob
import os
import re

from pages import RENAMED, SOURCE, blocks_of, check, code_of, has_word, new_folder, read, run

sources = [read(path) for path in sorted(glob.glob(os.path.join(SOURCE, "src", "case", "**", "*.c"), recursive=True))]
page = read("docs", "case.md")
code = code_of(page)

keys = {key for text in sources for key in re.findall(r'\.name = "(\w+)"', text)}
keys |= {key for text in sources for key in re.findall(r'\{OST_\w+,\s*"(\w+)",', text)}  # forms of axes and selections
check(len(keys) > 70 and {"mesh", "youngs_modulus", "nu12", "G13", "gradient", "nearest"} <= keys,
      f"keys are no longer found in src/case: {sorted(keys)}")
readers = [read(path) for path in glob.glob(os.path.join(SOURCE, "src", "case", "**", "read_*.c"), recursive=True)]
words = {word for text in readers for body in re.findall(r"char \*const \w+\[\w*\]\s*=\s*\{(.*?)\};", text, re.S)
         for word in re.findall(r'"(\w+)"', body)}
words |= set(re.findall(r'X\(OST_FIELD_\w+, "(\w+)"\)', read("include", "orthostat", "output_field.h")))
check({"metric", "geometric", "node_stress", "sphere_radius", "tangential"} <= words,
      f"words are no longer found: {sorted(words)}")
missing = sorted(word for word in keys | words if not has_word(code, word))
check(not missing, f"docs/case.md says nothing of {', '.join(missing)}")

# The other way round: the first column of the tables.
everything = "\n".join(read(path) for pattern in ("src/*/*.c", "src/case/*/*.c", "include/orthostat/*.h")
                       for path in glob.glob(os.path.join(SOURCE, pattern)))
for line in re.findall(r"^\| (.*?) \|", page, re.M):
    for key in re.findall(r"`(\w+)`", line):
        known = [key] + [old for old, new in RENAMED.items() if new == key]
        check(any(f'"{word}"' in everything for word in known), f"docs/case.md has '{key}', which the program does not know")

# The cases that the pages show are sound.
folder = new_folder()
for name in (("docs", "case.md"), ("README.md",)):
    shown = [block for block in blocks_of(read(*name), "yaml")
             if "loads:" in block and "mesh:" in block and "file: plank" not in block]
    check(shown, f"{name[-1]} shows no case")
    for block in shown:
        with open(os.path.join(folder, "shown.yaml"), "w", encoding="utf-8") as stream:
            stream.write(block)
        finished = run("check", "shown.yaml", folder=folder)
        check(finished.exit_code == 0 and not finished.errors, f"the case of {name[-1]}: {finished.errors}")
