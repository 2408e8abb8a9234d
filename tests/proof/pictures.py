"""Pictures of masks side by side, as PNG files."""
import struct
import zlib

import numpy as np

GAP = 4
ONLY_THEIRS_DARK = (208, 64, 48)
ONLY_OURS_DARK = (48, 96, 208)
NO_MASK = (186, 204, 222)


def write_png(path, rgb):
    """Writes an 8-bit picture of three channels."""
    height, width, _ = rgb.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), rgb.reshape(height, -1)], 1).tobytes()

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def grey(mask, compared=None):
    """Returns a mask as grey, with pixels that are not compared in pale blue."""
    out = np.repeat((255 * np.clip(mask, 0, 1) + 0.5).astype(np.uint8)[..., None], 3, 2)
    if compared is not None:
        out[~compared] = NO_MASK
    return out


def difference(theirs, ours, compared, interior):
    """Returns our mask in grey, with pixels that differ in colour: red if they are darker in the engine's mask, blue if
    they are darker in the program's. Pixels near edges are darker than interior pixels."""
    out = grey(np.where(interior, 1.0, 0.9) * (0.6 + 0.4 * ours), compared)
    differ = compared & (np.abs(theirs - ours) > 0.02)
    out[differ & (theirs < ours)] = ONLY_THEIRS_DARK
    out[differ & (theirs >= ours)] = ONLY_OURS_DARK
    return out


def side_by_side(pictures):
    """Returns pictures beside each other."""
    gap = np.full((pictures[0].shape[0], GAP, 3), 255, np.uint8)
    row = [pictures[0]]
    for picture in pictures[1:]:
        row += [gap, picture]
    return np.concatenate(row, 1)


def halved(rgb):
    """Returns a picture of half the width and height."""
    height, width = rgb.shape[0] // 2 * 2, rgb.shape[1] // 2 * 2
    parts = rgb[:height, :width].astype(np.uint16).reshape(height // 2, 2, width // 2, 2, 3)
    return ((parts.sum((1, 3)) + 2) // 4).astype(np.uint8)
