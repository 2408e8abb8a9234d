"""Comparison of a captured map with casters drawn again by a small rasteriser."""
import numpy as np

SUBPIXELS = 256
CHUNK = 3_000_000


def clip_far_out(triangles, owners):
    """Cuts triangles that reach behind the centre of projection or far beyond the viewport."""
    x, y, w = triangles[:, :, 0], triangles[:, :, 1], triangles[:, :, 3]
    least = 1e-6 * (np.abs(w).max() if w.size else 1.0)
    planes = [np.array([0, 0, 0, 1.0]), np.array([1, 0, 0, 2.0]), np.array([-1, 0, 0, 2.0]), np.array([0, 1, 0, 2.0]),
              np.array([0, -1, 0, 2.0])]
    good = ((w > least) & (np.abs(x) < 8 * w) & (np.abs(y) < 8 * w)).all(1)
    out = np.zeros(len(triangles), bool)
    for plane in planes:
        out |= (triangles @ plane <= (least if plane[0] == plane[1] else 0)).all(1)
    pieces, names = [triangles[good & ~out]], [owners[good & ~out]]
    for number in np.nonzero(~good & ~out)[0]:
        polygon = list(triangles[number])
        for plane in planes:
            edge = least if plane[0] == plane[1] else 0
            inside, kept = [float(p @ plane) - edge for p in polygon], []
            for i, a in enumerate(polygon):
                j = (i + 1) % len(polygon)
                if inside[i] > 0:
                    kept.append(a)
                if (inside[i] > 0) != (inside[j] > 0):
                    kept.append(a + inside[i] / (inside[i] - inside[j]) * (polygon[j] - a))
            polygon = kept
            if not polygon:
                break
        for i in range(1, len(polygon) - 1):
            pieces.append(np.array([[polygon[0], polygon[i], polygon[i + 1]]]))
            names.append(owners[number:number + 1])
    return np.concatenate(pieces), np.concatenate(names)


class Raster:
    """Depth, owner and slopes of the nearest surface of each texel of a viewport."""

    def __init__(self, width, height, reversed_):
        self.width, self.height, self.reversed = width, height, reversed_
        count = width * height
        self.depth = np.full(count, 0.0 if reversed_ else 1.0)  # with polygon offset
        self.plain = np.full(count, np.nan)                     # without
        self.owner = np.full(count, -1, np.int64)               # triangle of the last draw() that is nearest
        self.tag = np.full(count, -1, np.int64)
        self.uv = None

    def draw(self, clip, state, tag, step=None, keep=None):
        """Draws triangles, (n, 3, 4) clip positions in the orientation of the target's rows.

        @param step unit of the polygon offset; None: that of float depths
        @param keep function of (triangle, barycentric coordinates) that drops texels by a mask
        """
        if len(clip) == 0:
            return
        triangles, owners = clip_far_out(clip, np.arange(len(clip)))
        if len(triangles) == 0:
            return
        # Rasterisers compute with 32 bits.
        single = np.float32
        ndc = triangles[:, :, :3].astype(single) * (single(1) / triangles[:, :, 3:4].astype(single))
        if state.flipped:
            ndc = ndc * np.array([1, -1, 1], single)
        x = ndc[:, :, 0] * single(self.width / 2) + single(self.width / 2)
        y = ndc[:, :, 1] * single(self.height / 2) + single(self.height / 2)
        low, high = state.depth_range
        z = ndc[:, :, 2]
        if state.negative_one:
            z = z * single((high - low) / 2) + single((high + low) / 2)
        elif (low, high) != (0.0, 1.0):
            z = z * single(high - low) + single(low)
        limit = 1 << 40
        sx = np.clip(np.rint(x.astype(float) * SUBPIXELS), -limit, limit)
        sy = np.clip(np.rint(y.astype(float) * SUBPIXELS), -limit, limit)
        area = (sx[:, 1] - sx[:, 0]) * (sy[:, 2] - sy[:, 0]) - (sx[:, 2] - sx[:, 0]) * (sy[:, 1] - sy[:, 0])
        ccw = area > 0 if not state.flipped else area < 0
        front = ccw == state.front_ccw
        visible = area != 0
        if state.cull in ("back", "both"):
            visible &= front
        if state.cull in ("front", "both"):
            visible &= ~front
        chosen = np.nonzero(visible)[0]
        if len(chosen) == 0:
            return
        sx, sy, z, area, owners = sx[chosen], sy[chosen], z[chosen], area[chosen], owners[chosen]
        # Edges are those of rounded corners, planes of depth those of the corners themselves.
        tx, ty, z = x[chosen].astype(float), y[chosen].astype(float), z.astype(float)
        back = area < 0
        for values in (sx, sy, tx, ty, z):
            values[back] = values[back][:, [0, 2, 1]]
        swapped = back
        area = np.abs(area)
        # Plane of depth per texel.
        ax, ay, az = (tx[:, 1] - tx[:, 0]), (ty[:, 1] - ty[:, 0]), z[:, 1] - z[:, 0]
        bx, by, bz = (tx[:, 2] - tx[:, 0]), (ty[:, 2] - ty[:, 0]), z[:, 2] - z[:, 0]
        true_area = ax * by - bx * ay
        pixels = area / SUBPIXELS ** 2
        over = 1 / np.where(np.abs(true_area) < 1e-3 * pixels, pixels, true_area)
        dzdx, dzdy = (az * by - bz * ay) * over, (bz * ax - az * bx) * over
        origin = z[:, 0] - (dzdx * (tx[:, 0] - 0.5) + dzdy * (ty[:, 0] - 0.5))
        slope = np.maximum(np.abs(dzdx), np.abs(dzdy))
        if step is None:
            exponent = np.floor(np.log2(np.maximum(np.abs(z).max(1), 1e-38)))
            unit = 2.0 ** (exponent - 23)
        else:
            unit = step
        offset = state.factor * slope + state.units * unit
        if state.clamp > 0:
            offset = np.minimum(offset, state.clamp)
        elif state.clamp < 0:
            offset = np.maximum(offset, state.clamp)
        half = SUBPIXELS // 2
        x0 = np.clip(np.ceil((sx.min(1) - half) / SUBPIXELS), 0, self.width).astype(np.int64)
        x1 = np.clip(np.floor((sx.max(1) - half) / SUBPIXELS) + 1, 0, self.width).astype(np.int64)
        y0 = np.clip(np.ceil((sy.min(1) - half) / SUBPIXELS), 0, self.height).astype(np.int64)
        y1 = np.clip(np.floor((sy.max(1) - half) / SUBPIXELS) + 1, 0, self.height).astype(np.int64)
        w, h = np.maximum(x1 - x0, 0), np.maximum(y1 - y0, 0)
        # Very large triangles are cut into bands of rows, so that no chunk grows without bound.
        order = np.nonzero(w * h > 0)[0]
        start = 0
        while start < len(order):
            total, end = 0, start
            while end < len(order) and (end == start or total + w[order[end]] * h[order[end]] < CHUNK):
                total += w[order[end]] * h[order[end]]
                end += 1
            part = order[start:end]
            start = end
            counts = w[part] * h[part]
            t = np.repeat(part, counts)
            inside = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
            px = x0[t] + inside % w[t]
            py = y0[t] + inside // w[t]
            cx, cy = px * SUBPIXELS + half, py * SUBPIXELS + half
            good = np.ones(len(t), bool)
            weights = []
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                ex, ey = sx[t, k] - sx[t, j], sy[t, k] - sy[t, j]
                edge = ex * (cy - sy[t, j]) - ey * (cx - sx[t, j])
                owns = (ey < 0) | ((ey == 0) & (ex > 0))
                good &= (edge > 0) | ((edge == 0) & owns)
                weights.append(edge)
            index = np.nonzero(good)[0]
            if len(index) == 0:
                continue
            t, px, py = t[index], px[index], py[index]
            share = np.stack([e[index] for e in weights], 1) / area[t][:, None]
            depth = origin[t] + dzdx[t] * px + dzdy[t] * py
            depth = np.clip(depth, z[t].min(1), z[t].max(1))
            plain = depth
            depth = depth + (offset[t] if np.ndim(offset) else offset)
            lowest, highest = min(low, high), max(low, high)
            if state.depth_clamp:
                depth, kept = np.clip(depth, lowest, highest), np.ones(len(t), bool)
            else:
                kept = (plain >= lowest) & (plain <= highest)
                depth = np.clip(depth, 0, 1)
            if keep is not None and kept.any():
                original = share.copy()
                turned = swapped[t]
                original[turned] = original[turned][:, [0, 2, 1]]
                kept &= keep(owners[t], original)
            t, depth, plain = t[kept], depth[kept], plain[kept]
            flat = (py * self.width + px)[kept]
            rank = np.argsort(depth if self.reversed else -depth, kind="stable")
            flat, depth, plain, t = flat[rank], depth[rank], plain[rank], t[rank]
            # The last of equal places wins: the nearest.
            places, first = np.unique(flat[::-1], return_index=True)
            source = len(flat) - 1 - first
            near = depth[source] >= self.depth[places] if self.reversed else depth[source] <= self.depth[places]
            places, source = places[near], source[near]
            self.depth[places] = depth[source]
            self.plain[places] = plain[source]
            self.owner[places] = owners[t[source]]
            self.tag[places] = tag

    def covered(self):
        return self.tag >= 0


def step_of(fmt):
    """Returns the step of a depth format, or None for floats."""
    if fmt.startswith("D16"):
        return 1 / 65535
    if fmt.startswith("D24"):
        return 1 / 16777215
    return None


def compare_depths(captured, own, both, step):
    """Returns median and 99th percentile of the distance in steps, and the median signed difference."""
    if not both.any():
        return {"texels": 0}
    difference = captured[both] - own[both]
    # Rasterisers interpolate floats with an error of the last place of 1, however small the depth is.
    steps = np.abs(difference) / (step if step else 2.0 ** -23)
    return {"texels": int(both.sum()), "median_steps": float(np.median(steps)),
            "percentile_99_steps": float(np.percentile(steps, 99)), "median": float(np.median(difference))}


def fit_bias(difference, cosine):
    """Fits a shift of depth to 1, tan(angle) and 1 - n.l. Returns the coefficients and the residual (RMS)."""
    tangent = np.sqrt(np.maximum(1 - cosine ** 2, 0)) / np.maximum(cosine, 1e-3)
    good = np.isfinite(difference) & (cosine > 0.05)
    if good.sum() < 16:
        return None
    table = np.stack([np.ones(good.sum()), tangent[good], 1 - cosine[good]], 1)
    values = difference[good]
    for _ in range(3):
        solution = np.linalg.lstsq(table, values, rcond=1e-9)[0]
        error = values - table @ solution
        spread = 1.4826 * np.median(np.abs(error)) + 1e-12
        inside = np.abs(error) < 6 * spread
        if inside.all() or inside.sum() < 16:
            break
        table, values = table[inside], values[inside]
    return {"constant": float(solution[0]), "tangent": float(solution[1]), "one_minus_cosine": float(solution[2]),
            "residual": float(np.sqrt(np.mean(error ** 2))), "unit": "depth"}
