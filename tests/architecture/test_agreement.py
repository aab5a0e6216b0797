"""No rank returns on a failure of its own to allocate before a call that needs all ranks: the others would wait."""
import os
import re

SOURCE = os.environ.get("ORTHOSTAT_SOURCE", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))

FUNCTION = re.compile(r"^([A-Za-z_][^\n;{}=]*?\b(\w+)\([^;{}]*?\))\s*\{\n(.*?)^\}", re.MULTILINE | re.DOTALL)
MPI = re.compile(r"MPI_(I?send|I?recv|Wait|All|Bcast|I?gather|Scatter|Scan|Exscan|Reduce|Barrier|Comm_split|File_)", re.I)
CALL = re.compile(r"\b(\w+)\(")
STEP = re.compile(r"(OST_TRY|OST_TRY_DONE|OST_THEN|return|status =)[ (]\s*(\w+)\(")
ALLOCATES = {"OST_NEW", "OST_RESIZE", "OST_GROW", "ost_allocate"}

# They only word a failure that all ranks have.
ALIKE_ON_ALL = {"ost_case_located", "name_file", "ost_select_check_names"}
ACCEPTED = {
    ("src/mesh/distribution/distribute.c", "take_all"): "it is the only rank",
    ("src/problem/problem.c", "fill"): "the stiffness is collective where nodes follow others, and there are no factors",
    ("src/problem/coarse_space.c", "ost_linear_space_move"): "nodes that follow others have no linear space",
}
EXAMPLE = """static OstStatus early(void)
{
    OST_TRY(OST_NEW(ctx, &a, 1));
    return OST_MPI(ctx, MPI_Barrier(comm));
}
static OstStatus agreed(void)
{
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &a, 1)));
    return OST_MPI(ctx, MPI_Barrier(comm));
}
"""


def read_functions(sources):
    """{(path, name): (first line, body)}, and which function a name means in other files."""
    functions, shared = {}, {}
    for path, text in sources.items():
        text = re.sub(r"/\*.*?\*/", lambda found: re.sub(r"[^\n]", " ", found[0]), text, flags=re.DOTALL)
        for found in FUNCTION.finditer(text):
            functions[path, found[2]] = (text.count("\n", 0, found.start(3)) + 1, found[3])
            if not found[1].startswith("static"):
                shared[found[2]] = (path, found[2])
    return functions, lambda path, name: (path, name) if (path, name) in functions else shared.get(name)


def callers_too(functions, meant, kept, pattern, left_out=()):
    """`kept`, and all that call it in a way that the pattern finds."""
    calls = {key: {meant(key[0], found[found.lastindex]) for found in pattern.finditer(body)}
             for key, (_, body) in functions.items()}
    grows = True
    while grows:
        more = {key for key, called in calls.items() if key not in kept and key not in left_out and called & kept}
        kept, grows = kept | more, bool(more)
    return kept


def find_early_returns(sources):
    functions, meant = read_functions(sources)
    collective = callers_too(functions, meant, {key for key, (_, body) in functions.items()
                                                if any(MPI.match(name) for name in CALL.findall(body))}, CALL)
    left_out = collective | {key for key in functions if key[1] in ALIKE_ON_ALL}
    local = callers_too(functions, meant, {key for key, (_, body) in functions.items() if key not in left_out
                                           and ALLOCATES & set(CALL.findall(body))}, STEP, left_out)
    for (path, name), (line, body) in functions.items():
        for step in STEP.finditer(body):
            if step[1] == "return" or not (step[2] in ALLOCATES or meant(path, step[2]) in local):
                continue
            end = body.find("\ndone:") if step[1] == "OST_TRY_DONE" else len(body)
            after = next((call for call in CALL.findall(body[step.end():end])
                          if MPI.match(call) or meant(path, call) in collective), None)
            if after and (after != "ost_agree" or step[1].startswith("OST_TRY")):
                yield path, name, f"{path}:{line + body.count(chr(10), 0, step.start())}: {step[2]} before {after}"


def read_sources():
    sources = {}
    for place, _, names in os.walk(os.path.join(SOURCE, "src")):
        for name in names:
            if name.endswith((".c", ".cpp")):
                path = os.path.join(place, name)
                with open(path) as stream:
                    sources[os.path.relpath(path, SOURCE)] = stream.read()
    return sources


def main():
    assert [name for _, name, _ in find_early_returns({"example.c": EXAMPLE})] == ["early"]
    found = list(find_early_returns(read_sources()))
    failures = [text for path, name, text in found if (path, name) not in ACCEPTED]
    failures += [f"{path}: {name} need not be accepted any more"
                 for path, name in ACCEPTED if (path, name) not in {key[:2] for key in found}]
    if failures:
        raise SystemExit("FAILED: agree first, OST_TRY(ost_agree(ctx, …)):\n" + "\n".join(failures))


main()
