# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the words of a package's change log against those of CHANGELOG.md: changelog_words.py CHANGELOG.md changelog.gz"""
import gzip
import re
import sys


def entries_of(text, heading, item, end):
    """{version: the words of its items, as one list}, of what stands between a heading and `end` or the next heading."""
    found, words = {}, None
    for line in text.splitlines():
        begins = re.match(heading, line)
        if begins:
            words = found.setdefault(begins.group(1), [])
        elif end and re.match(end, line):
            words = None
        elif words is not None:
            words += re.sub(item, "ITEM ", line).split()
    return found


with open(sys.argv[1], encoding="utf-8") as file:
    wanted = entries_of(file.read(), r"## (\S+) \(", r"^- ", None)
with gzip.open(sys.argv[2], "rt", encoding="utf-8") as file:
    packed = entries_of(file.read(), r"batten \((\S+)\) ", r"^  \* ", r"^ -- ")
if list(packed) != list(wanted):
    sys.exit("The package's change log has the versions %s, CHANGELOG.md has %s." % (list(packed), list(wanted)))
for version, words in wanted.items():
    for number, (a, b) in enumerate(zip(words + [None], packed[version] + [None])):
        if a != b:
            sys.exit("%s: the package's change log reads \"%s\", CHANGELOG.md \"%s\"." % (
                version, " ".join(packed[version][max(0, number - 5):number + 3]), " ".join(words[max(0, number - 5):number + 3])))
print("change log: %d words of %d versions" % (sum(map(len, wanted.values())), len(wanted)))
