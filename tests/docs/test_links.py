"""Every relative link of the pages leads somewhere; what the front page shows is what lies in cases/; the citation is valid."""
import os
import re

from pages import PAGES, SOURCE, blocks_of, check, read


def anchors_of(path):
    """As GitHub makes them of headings."""
    with open(path, encoding="utf-8") as stream:
        text = re.sub(r"^```.*?^```", "", stream.read(), flags=re.M | re.S)
    return {re.sub(r"[^\w\- ]", "", heading.lower().replace("`", "")).strip().replace(" ", "-")
            for heading in re.findall(r"^#+ (.*)$", text, re.M)}


links = 0
for page in PAGES:
    with open(page, encoding="utf-8") as stream:
        text = re.sub(r"^```.*?^```", "", stream.read(), flags=re.M | re.S)
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"https?://", target):
            continue
        links += 1
        path, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        where = f"{os.path.relpath(page, SOURCE)}: {target}"
        check(os.path.exists(path), f"{where} does not exist")
        check(not anchor or anchor in anchors_of(path), f"{where}: there is no such heading")
check(links > 50, f"only {links} links were found")

readme = read("README.md")
for language, name in (("", "plank.geo"), ("yaml", "plank.yaml")):
    check(read("cases", "plank", name) in blocks_of(readme, language), f"README.md does not show cases/plank/{name} as it is")
check(len(readme.splitlines()) <= 150, "README.md is a front page; what is long belongs into docs/")

version = re.search(r"project\(orthostat VERSION ([\d.]+)", read("CMakeLists.txt"))[1]
citation = dict(re.findall(r"^([\w-]+): ?(.*)$", read("CITATION.cff"), re.M))
check({"cff-version", "message", "title", "authors", "version", "license"} <= citation.keys(), f"CITATION.cff: {citation}")
check(citation["version"] == version, f"CITATION.cff is of version {citation['version']}, the project of {version}")
check(f"## [{version}]" in read("CHANGELOG.md"), f"CHANGELOG.md has nothing of version {version}")
