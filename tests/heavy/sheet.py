# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens curves/index.html of an archive in headless Chromium and asks the browser what it shows: sheet.py ARCHIVE PROFILE PICTURE"""
import collections
import html
import json
import os
import re
import subprocess
import sys
import urllib.parse

archive, profile, picture = (os.path.abspath(name) for name in sys.argv[1:4])
folder = os.path.join(archive, "curves")
# Put at the end of a copy of the sheet that loads all pictures at once: writes what is there into the page.
QUESTIONS = """<script>
addEventListener("load", () => {
  const shown = () => [...document.querySelectorAll("main svg")].filter(one => getComputedStyle(one).display != "none").length;
  const cards = [...document.querySelectorAll("figure")].map(card => {
    const image = card.querySelector("img"), svg = card.querySelector("svg"), box = svg && svg.getBoundingClientRect();
    const place = image && image.getBoundingClientRect();
    const paths = svg ? [...svg.querySelectorAll("path")].map(path => path.getBoundingClientRect()) : [];
    return {kind: card.className, name: card.querySelector("b").textContent, text: card.querySelector("small").textContent,
            loaded: image ? image.naturalWidth : null, paths: paths.length,
            drawn: paths.reduce((sum, p) => sum + p.width + p.height, 0),
            covers: !svg || (Math.abs(box.left - place.left) < 1 && Math.abs(box.right - place.right) < 1 &&
                             Math.abs(box.top - place.top) < 1 && Math.abs(box.bottom - place.bottom) < 1),
            inside: paths.every(p => p.left > place.left - 2 && p.right < place.right + 2 && p.top > place.top - 2 &&
                                     p.bottom < place.bottom + 2),
            aspect: image && place.width / place.height, natural: image && image.naturalWidth / image.naturalHeight,
            links: [...card.querySelectorAll("a")].map(a => a.href)};
  });
  const before = shown();
  document.getElementById("curves").click();
  const answer = {title: document.title, mode: document.compatMode, cards, before, after: shown(),
                  wide: document.documentElement.scrollWidth <= innerWidth};
  const element = document.createElement("script");
  element.type = "application/json";
  element.id = "answer";
  element.textContent = JSON.stringify(answer).replaceAll("<", "\\\\u003c");
  document.body.append(element);
});
</script></body>"""


def fail(text):
    sys.exit("FAILED: " + text)


def chromium(*words):
    # No sandbox: it needs rights that a container does not give. Nothing is asked of the network.
    command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
               "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions",
               "--user-data-dir=" + profile, "--window-size=1400,1000", "--virtual-time-budget=20000", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=True).stdout


def main():
    with open(os.path.join(folder, "index.html"), encoding="utf-8") as file:
        sheet = file.read()
    asking = os.path.join(folder, "asking.html")
    with open(asking, "w", encoding="utf-8") as file:
        file.write(sheet.replace(' loading="lazy"', "").replace("</body>", QUESTIONS))
    page = chromium("--dump-dom", "file://" + urllib.parse.quote(asking))
    os.remove(asking)
    found = re.search(r'<script type="application/json" id="answer">(.*?)</script>', page, re.S)
    if not found:
        fail("the browser gave no answer")
    answer = json.loads(html.unescape(found.group(1)))
    with open(os.path.join(archive, "results.jsonl"), encoding="utf-8") as file:
        results = {os.path.basename(one["scan"]): one for one in map(json.loads, file)}
    if answer["mode"] != "CSS1Compat":
        fail("the sheet is no standard HTML")
    if not answer["wide"]:
        fail("the sheet is wider than the window")
    if sorted(card["name"] for card in answer["cards"]) != sorted(results):
        fail("the sheet shows %s" % [card["name"] for card in answer["cards"]])
    links = 0
    for card in answer["cards"]:
        result = results[card["name"]]
        if card["kind"] != result["status"]:
            fail("%s is shown as %s and is %s" % (card["name"], card["kind"], result["status"]))
        if card["kind"] == "failed":
            if card["text"] != result["error"]:
                fail("%s says %s" % (card["name"], card["text"]))
            continue
        if not card["loaded"] or abs(card["aspect"] / card["natural"] - 1) > 0.02:
            fail("the picture of %s is not there, or not of its shape" % card["name"])
        if card["kind"] == "done":
            if card["paths"] != result["pieces"] and card["paths"] < result["curves"]:
                fail("%s shows %d curves of %d" % (card["name"], card["paths"], result["curves"]))
            if not (card["covers"] and card["inside"] and card["drawn"] > 20):
                fail("the curves of %s do not lie on its picture" % card["name"])
            if not card["text"].startswith("%d curve" % result["curves"]):
                fail("%s says %s" % (card["name"], card["text"]))
        for link in card["links"]:
            name = urllib.parse.unquote(urllib.parse.urlparse(link).path)
            if not os.path.isfile(name):
                fail("%s: %s leads nowhere" % (card["name"], link))
            links += 1
    kinds = collections.Counter(card["kind"] for card in answer["cards"])
    if answer["before"] != kinds["done"] or answer["after"] != 0:
        fail("the switch for the curves leaves %d of %d" % (answer["after"], answer["before"]))
    chromium("--screenshot=" + picture, "file://" + urllib.parse.quote(os.path.join(folder, "index.html")))
    print("%s; %d links lead to files; picture: %s" %
          (", ".join("%d %s" % (n, kind) for kind, n in sorted(kinds.items())), links, picture))


main()
