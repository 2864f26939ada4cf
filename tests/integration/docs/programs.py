# SPDX-License-Identifier: Apache-2.0
"""What telehug's programs say of themselves by --help."""
import functools
import re
import subprocess

PROGRAMS = ("telehug", "telehug-active", "telehug-passive", "telehug-jacket-sim")


class Programs:
    def __init__(self, folder):
        self.folder = folder

    @functools.lru_cache(maxsize=None)
    def help(self, path):
        """Of a tuple of words such as ("telehug", "pair", "invite")."""
        said = subprocess.run([f"{self.folder}/{path[0]}", *path[1:], "--help"], capture_output=True, text=True,
                              timeout=20, check=True)
        return said.stdout

    def part(self, path, title):
        found = re.search(rf"^{title}:\n((?:.+\n)+)", self.help(path), re.MULTILINE)
        return found.group(1) if found else ""

    def commands(self, path):
        return set(re.findall(r"^  (\S+)", self.part(path, "Subcommands"), re.MULTILINE))

    def options(self, path):
        """Name of each, and whether it takes a value."""
        found = {}
        for names, rest in re.findall(r"^  (-\S+)(.*)$", self.part(path, "Options"), re.MULTILINE):
            takes_value = bool(re.match(r" [A-Z]", rest)) or ":" in names
            for name in names.split(":")[0].split(","):
                found[name] = takes_value
        return found

    def positionals(self, path):
        return len(re.findall(r"^  \S", self.part(path, "Positionals"), re.MULTILINE))

    def exit_codes(self, program):
        return {int(code) for code in re.findall(r"^ +(\d+)  ", self.part((program,), "Exit codes"), re.MULTILINE)}

    def fault_of(self, words):
        """Why this command line can't be right, as far as names go; None if it may be. "..." stands for anything, and
        so does a word in capitals."""
        path = (words[0],)
        rest = list(words[1:])
        while rest and self.commands(path) and not rest[0].startswith("-"):
            choices = rest[0].split("|")
            if not set(choices) <= self.commands(path):
                return None if rest[0] in ("...", "COMMAND") else f"{' '.join(path)} has no command {rest[0]}"
            path = (*path, choices[0])
            rest.pop(0)
        options = self.options(path)
        if path[1:] == () and "--reference" in rest:  # of the build alone (common/cli), so --help does not tell it
            return None
        others = 0
        while rest:
            word = rest.pop(0)
            name, _, value = word.strip("[],").partition("=")
            if not name.startswith("-") or name == "-":
                others += 1
                continue
            if name not in options:
                return f"{' '.join(path)} has no option {name}"
            if options[name] and not value and rest:
                quote = rest[0][0] if rest[0][0] in "\"'" else None
                taken = rest.pop(0)
                while quote and rest and not taken.endswith(quote):
                    taken = rest.pop(0)
        if others and not self.positionals(path):
            return f"{' '.join(path)} takes no words behind it"
        return None
