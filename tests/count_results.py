#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests came to: count_results.py REPORTS LOG adds up the reports of all suites that the log of ctest names.

The last line is "N passed, N failed"; the status is 0 if none failed. A suite without a report (it crashed, or ran into
its limit of time) counts as one test that failed. A test may skip only for want of sketches of one's own
(BATTEN_SKETCHES); any other skip is a test that does not test, and counts as failed.
"""
import json
import pathlib
import re
import sys


def results(report):
    """(name, result) of every test that was to run: "COMPLETED", "SKIPPED" or "FAILED"."""
    for suite in report["testsuites"]:
        for test in suite["testsuite"]:
            if test["status"] != "RUN":
                continue
            yield f'{suite["name"]}.{test["name"]}', "FAILED" if "failures" in test else test["result"]


def main():
    reports, log = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).read_text(errors="replace")
    suites = re.findall(r"^ *[0-9]+/[0-9]+ Test +#[0-9]+: (\S+)", log, re.MULTILINE)
    passed, skipped, failed = 0, 0, []
    for suite in suites:
        path = reports / (suite.replace("/", "_") + ".json")
        if not path.exists():
            failed.append(f"{suite}: ended without a report")
            continue
        for name, result in results(json.loads(path.read_text())):
            if result == "FAILED":
                failed.append(name)
            elif result != "SKIPPED":
                passed += 1
            elif "OwnSketches" in name:
                skipped += 1
            else:
                failed.append(f"{name}: skipped without need")
    if not suites:
        failed.append("no suite ran")
    for line in failed:
        print("FAILED", line)
    print(f"{skipped} skipped for want of BATTEN_SKETCHES")
    print(f"{passed} passed, {len(failed)} failed")
    return 1 if failed else 0


sys.exit(main())
