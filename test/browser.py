"""A report in headless Chromium."""

import shutil
import subprocess
from pathlib import Path

import pytest

needs_chromium = pytest.mark.skipif(
    shutil.which('chromium') is None, reason='needs chromium (Debian: apt install chromium)'
)

# The browser tells what stands in a page once it is loaded, and this one is not before its second
# frame is closed: when no figure was drawn for two seconds, or none at all in a minute.
FRAME = """<iframe src="report.html" style="border: 0; width: %dpx; height: 8000px"></iframe>
<iframe></iframe>
<script>
const [page, open] = document.querySelectorAll('iframe'), dom = () => page.contentDocument;
open.contentDocument.open();
let drawn = 0, since = Date.now();
setInterval(() => {
  const now = dom().querySelectorAll('.js-plotly-plot').length, wait = now ? 2000 : 60000;
  if (now != drawn) [drawn, since] = [now, Date.now()];
  if (Date.now() < since + wait) return;
  document.title = %s;
  open.contentDocument.close();
}, 100);
</script>"""


def browsed(report: Path, width: int, said: str) -> str:
    """Return what a script says of a page, so wide, after a browser has drawn its figures."""
    frame = report / 'frame.html'
    frame.write_text(FRAME % (width, said))
    quiet = ['--disable-background-networking', '--disable-component-update', '--disable-sync']
    flags = ['--headless', '--no-sandbox', '--disable-gpu', '--hide-scrollbars', *quiet]
    where = [f'--user-data-dir={report}/profile', '--window-size=1400,9000']
    what = ['--allow-file-access-from-files', '--dump-dom', f'file://{frame}']
    command = ['chromium', *flags, *where, *what]
    dom = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True).stdout
    return dom.partition('<title>')[2].partition('</title>')[0]
