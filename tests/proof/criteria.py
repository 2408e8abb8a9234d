"""Criteria of the proof: interiors, edges and the beginning of acne."""
import numpy as np

INTERIOR_TEXELS = 3
INTERIOR_PIXELS = 2
MIN_INTERIOR_SHARE = 0.60
MIN_EQUAL_SHARE = 0.995
MAX_DIFFERENCE = 0.02     # of a pixel's visibility, for equal
MAX_EDGE_TEXELS = 1.5
MIN_NEAR_SHARE = 0.995    # of the pixels around edges, for edges within that distance
MAX_DARK_SHARE = 0.001    # of a plane's pixels, for no acne
DARK = 1 - MAX_DIFFERENCE  # visibility below which a pixel is dark
GRID_STEP = 1.05          # of the grid on which acne is sought
MAX_ACNE_RATIO = 1.10


def edge_pixels(mask):
    """Returns the pixels on both sides of each edge of a mask."""
    lit = mask >= 0.5
    out = np.zeros(lit.shape, bool)
    across, down = lit[:, 1:] != lit[:, :-1], lit[1:] != lit[:-1]
    out[:, 1:] |= across
    out[:, :-1] |= across
    out[1:] |= down
    out[:-1] |= down
    return out


def dilated(flags, radius):
    """Returns flags grown by a disk of a radius, in cells."""
    out = flags.copy()
    reach = int(np.floor(radius))
    height, width = flags.shape
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            if dx * dx + dy * dy > radius * radius or (dx == 0 and dy == 0):
                continue
            to_y, to_x = slice(max(dy, 0), height + min(dy, 0)), slice(max(dx, 0), width + min(dx, 0))
            from_y, from_x = slice(max(-dy, 0), height + min(-dy, 0)), slice(max(-dx, 0), width + min(-dx, 0))
            out[to_y, to_x] |= flags[from_y, from_x]
    return out


def interior(reference, compared, texels):
    """Returns the compared pixels that are farther from every edge of the reference than 3 texels and 2 pixels.

    texels has the place of each pixel in the map, in texels. Distances in texels count across the light's rays, so a
    surface behind an edge is left out, too."""
    near = dilated(edge_pixels(reference) & compared, INTERIOR_PIXELS) & compared
    # Cells of half a texel hold the zone around the edges.
    scale = 2
    at = np.floor(texels[near] * scale).astype(int)
    low = at.min(0) - 16 if len(at) else np.zeros(2, int)
    size = (at.max(0) - low + 16) if len(at) else np.ones(2, int)
    zone = np.zeros((size[1], size[0]), bool)
    if len(at):
        zone[at[:, 1] - low[1], at[:, 0] - low[0]] = True
        zone = dilated(zone, INTERIOR_TEXELS * scale + 0.75)
    cells = np.floor(np.nan_to_num(texels) * scale).astype(int) - low
    inside = (cells[..., 0] >= 0) & (cells[..., 1] >= 0) & (cells[..., 0] < size[0]) & (cells[..., 1] < size[1])
    marked = np.zeros(reference.shape, bool)
    marked[inside] = zone[cells[..., 1][inside], cells[..., 0][inside]]
    return compared & ~near & ~marked


def edge_offsets(theirs, ours, compared, texels, reach=24):
    """Returns the pixels where two masks differ, and how far their edges are apart there, in texels.

    The distance is that to the nearest pixel where our mask has the engine's value. A neighbouring pixel counts as 0,
    as the picture shows no smaller distance."""
    a, b = theirs >= 0.5, ours >= 0.5
    ys, xs = np.nonzero((a != b) & compared)
    offsets = np.full(len(ys), np.inf)
    height, width = a.shape
    for i, (y, x) in enumerate(zip(ys, xs)):
        y0, x0 = max(y - reach, 0), max(x - reach, 0)
        window = (slice(y0, min(y + reach + 1, height)), slice(x0, min(x + reach + 1, width)))
        same = compared[window] & (b[window] == a[y, x])
        if not same.any():
            continue
        wy, wx = np.nonzero(same)
        if (np.maximum(np.abs(wy + y0 - y), np.abs(wx + x0 - x)) <= 1).any():
            offsets[i] = 0
        else:
            offsets[i] = np.linalg.norm(texels[window][same] - texels[y, x], axis=1).min()
    return ys, xs, offsets


def compare(theirs, ours, reference, compared, texels):
    """Compares two masks by all criteria. Returns numbers and whether each is met."""
    inner = interior(reference, compared, texels)
    count, inside = int(compared.sum()), int(inner.sum())
    equal = np.abs(theirs - ours) <= MAX_DIFFERENCE
    equal_share = float(equal[inner].mean()) if inside else 0.0
    ys, xs, offsets = edge_offsets(theirs, ours, compared & ~inner, texels)
    beyond = int((offsets > MAX_EDGE_TEXELS).sum())
    band = count - inside
    result = {"compared_px": count, "interior_px": inside, "interior_share": inside / max(count, 1),
              "equal_share": equal_share, "edge_px": band, "edge_differ_px": len(offsets), "edge_beyond_px": beyond,
              "edge_max_texels": float(offsets.max()) if len(offsets) and np.isfinite(offsets.max()) else
              (None if len(offsets) else 0.0),
              "lit_share": float((theirs[compared] >= 0.5).mean()) if count else 0.0}
    result["passed"] = {"interior": result["interior_share"] >= MIN_INTERIOR_SHARE,
                        "equal": equal_share >= MIN_EQUAL_SHARE, "edges": beyond <= (1 - MIN_NEAR_SHARE) * band}
    return result


def dark_share(mask, pixels=None):
    """Returns the share of a plane's pixels that are dark."""
    values = mask if pixels is None else mask[pixels]
    return float((values < DARK).mean())


def acne_begins(shares):
    """Returns the smallest step without acne and none above it with acne; None if the last step has acne.

    shares maps steps of the grid to shares of dark pixels."""
    steps = sorted(shares)
    found = None
    for step in reversed(steps):
        if shares[step] >= MAX_DARK_SHARE:
            break
        found = step
    return found
