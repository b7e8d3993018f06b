#!/usr/bin/env python3
"""Opens the report of a comparison in headless Chromium: every picture must have been drawn, nothing fetched from elsewhere.

usage: open_in_browser.py FOLDER LEAST_PICTURES
"""
import os
import re
import subprocess
import sys
import tempfile

COUNT = """<script>addEventListener("load", () => {
  const all = [...document.images], drawn = all.filter(image => image.complete && image.naturalWidth > 100);
  document.body.insertAdjacentHTML("beforeend", `<p id="seen">${drawn.length} of ${all.length}</p>`);
});</script>"""


def main(folder, least):
    with open(os.path.join(folder, "report.html")) as file:
        page = file.read()
    with tempfile.TemporaryDirectory() as home:
        probe = os.path.join(home, "probe.html")
        with open(probe, "w") as out:
            out.write(page.replace("</html>", COUNT + "</html>"))
        command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={home}/profile", "--virtual-time-budget=20000", "--dump-dom",
                   f"file://{probe}"]
        dom = subprocess.run(command, check=True, capture_output=True, text=True, timeout=100).stdout
    seen = re.search(r'id="seen">(\d+) of (\d+)<', dom)
    if not seen:
        sys.exit("the browser did not come to the end of the page")
    drawn, pictures = map(int, seen.groups())
    away = re.findall(r'(?:src|href)="(?!data:)([^"]*)"', page)
    if drawn != pictures or pictures < least or away:
        sys.exit(f"{drawn} of {pictures} pictures drawn, at least {least} wanted; from elsewhere: {away}")
    for heading in ("Errors", "Cost and conservation", "Gauges", "Fields at", "Where the time went"):
        if f"<h2>{heading}" not in dom:
            sys.exit(f"no section {heading}")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
