# SPDX-License-Identifier: Apache-2.0
"""An X server without a monitor, whose picture can be read."""
import os
import select
import struct
import subprocess
import time
import zlib

MARKER = [(0xFE, 0x01, 0xFD), (0x02, 0xFE, 0x03), (0x03, 0x04, 0xFC), (0xFD, 0xFE, 0x05)]  # as in chat_page.js


class Xvfb:
    """Runs on a free display while it is entered. `folder` takes its picture, an XWD file in shared memory."""

    def __init__(self, folder, width_px, height_px):
        self.width_px, self.height_px = width_px, height_px
        self.folder = folder
        self._process = None
        self.display = ""

    def __enter__(self):
        reader, writer = os.pipe()
        self._process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", f"{self.width_px}x{self.height_px}x24", "-fbdir",
             self.folder, "-nolisten", "tcp", "-noreset"],
            pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writer)
        try:
            self.display = ":" + _read_line(reader, 20)
        except BaseException:
            self.__exit__()
            raise
        finally:
            os.close(reader)
        return self

    def __exit__(self, *_):
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def rows(self):
        """The rows of the picture now: bytes of B, G, R and one without a meaning, a pixel after the other."""
        with open(os.path.join(self.folder, "Xvfb_screen0"), "rb") as file:
            data = file.read()
        header = struct.unpack_from(">25I", data)
        begin, bits_per_pixel, row_bytes, colours = header[0] + 12 * header[19], header[11], header[12], header[19]
        assert (bits_per_pixel, colours) == (32, 256), "this Xvfb draws with another depth"
        return [data[begin + row * row_bytes:begin + row * row_bytes + 4 * self.width_px]
                for row in range(self.height_px)]

    def find_marker(self):
        """Where the page's marker, two by two fields of its colours, has its top left corner: x, y and the side of a
        field in px of the monitor; None if it is not shown."""
        first, second, third, _ = (bytes((b, g, r)) for r, g, b in MARKER)
        rows = self.rows()
        for y, row in enumerate(rows):
            x = _pixel_of(row, first)
            if x is None:
                continue
            side = 1
            while row[4 * (x + side):4 * (x + side) + 3] == first:
                side += 1
            below = rows[y + side][4 * x:4 * x + 3] if y + side < len(rows) else b""
            if row[4 * (x + side):4 * (x + side) + 3] == second and below == third:
                return x, y, side
        return None

    def save_png(self, path):
        rows = []
        for row in self.rows():
            rgb = bytearray(3 * self.width_px)
            rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
            rows.append(b"\0" + bytes(rgb))
        chunks = [(b"IHDR", struct.pack(">IIBBBBB", self.width_px, self.height_px, 8, 2, 0, 0, 0)),
                  (b"IDAT", zlib.compress(b"".join(rows), 6)), (b"IEND", b"")]
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n")
            for name, body in chunks:
                file.write(struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body)))


def _read_line(reader, timeout_s):
    """The number of the display. Xvfb gives up if its line is not read to the end."""
    line = b""
    give_up = time.monotonic() + timeout_s
    while not line.endswith(b"\n"):
        ready, _, _ = select.select([reader], [], [], max(0.0, give_up - time.monotonic()))
        part = os.read(reader, 32) if ready else b""
        if not part:
            raise RuntimeError(f"Xvfb did not start within {timeout_s} s")
        line += part
    return line.decode().strip()


def _pixel_of(row, colour):
    """The first pixel of a row that has the colour."""
    at = row.find(colour)
    while at >= 0 and at % 4 != 0:
        at = row.find(colour, at + 1)
    return None if at < 0 else at // 4
