"""Every command and option of the program stands in docs/commands.md, and nothing that is no option."""
import re

from pages import RENAMED, check, read, run

page = read("docs", "commands.md")
sections = {heading: text for heading, text in re.findall(r"^## (\w+)\n(.*?)(?=^## |\Z)", page, re.M | re.S)}
common = page.split("\n## ", 1)[0]
commands = re.findall(r"^  (\w+)  ", run("--help").output, re.M)
check(len(commands) >= 6 and sorted(commands) == sorted(sections), f"commands {commands}, pages {sorted(sections)}")
for command in commands:
    check(f"`{command}" in read("README.md"), f"README.md says nothing of {command}")
    listed = {RENAMED.get(option, option)
              for option in re.findall(r"(?<![\w-])(--\w[\w-]*)", run(command, "--help").output)}
    told = set(re.findall(r"(?<![\w-])(--\w[\w-]*)", sections[command]))
    general = set(re.findall(r"(?<![\w-])(--\w[\w-]*)", common)) | {"--help"}
    check(listed <= told | general, f"{command}: docs/commands.md says nothing of {sorted(listed - told - general)}")
    check(told <= listed, f"{command}: docs/commands.md has {sorted(told - listed)}, which are no options")
