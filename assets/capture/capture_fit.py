"""Matrices of draws, found from positions before and after the vertex shader.

No name of a constant is trusted: a matrix counts only where it takes the inputs to the outputs.
"""
import numpy as np

# Largest residual, as a share of the row's largest value, of rows that a matrix explains.
MATRIX_RESIDUAL = 2e-5
MAX_WINDOWS = 320


def homogeneous(points):
    points = np.asarray(points, float)
    if points.shape[1] >= 4:
        w = points[:, 3:4]
        return np.hstack([points[:, :3], w]) if np.ptp(w) == 0 and w[0, 0] == 1 else \
            np.hstack([points[:, :3], np.ones((len(points), 1))])
    if points.shape[1] == 2:
        points = np.hstack([points, np.zeros((len(points), 1))])
    return np.hstack([points[:, :3], np.ones((len(points), 1))])


def fit_matrix(points, clip):
    """Fits clip = M * point. Returns M, the relative residual of each row and the rank of the points."""
    solution, _, rank, _ = np.linalg.lstsq(points, clip, rcond=1e-9)
    error = np.abs(points @ solution - clip).max(0)
    scale = np.maximum(np.abs(clip).max(0), 1e-30)
    # A row of zeros is explained by any scale.
    scale = np.maximum(scale, 1e-6 * np.abs(clip).max())
    return solution.T, error / scale, rank


def position_attribute(draw):
    """Returns the name of the input that best explains the clip positions, with its fit."""
    best = None
    for name, values in draw.attributes.items():
        if values.shape[1] < 2:
            continue
        points = homogeneous(values)[draw.indices]
        matrix, error, rank = fit_matrix(points, draw.clips[0])
        score = max(error[0], error[1], error[3])
        if np.ptp(values, axis=0).max() == 0:
            continue
        if best is None or score < best[0]:
            best = (score, name, matrix, error, rank)
    return best


def windows(constants):
    """Returns keys and (n, 4, 4) matrices of all 4x4 windows of the constants, in three layouts."""
    keys, matrices, seen = [], [], {}
    for key, data in constants:
        floats = np.frombuffer(data[:len(data) // 4 * 4], "<f4").astype(float)
        for at in range(0, len(floats) - 11, 4):
            for layout, count in (("columns", 16), ("rows", 16), ("rows3", 12)):
                if at + count > len(floats):
                    continue
                part = floats[at:at + count]
                matrix = layout_matrix(part, layout)
                if not np.isfinite(matrix).all():
                    continue
                largest = np.abs(matrix).max()
                if largest == 0 or largest > 1e8:
                    continue
                if abs(np.linalg.det(matrix / largest)) < 1e-18:
                    continue
                mark = matrix.tobytes()
                if mark in seen:
                    continue
                seen[mark] = True
                keys.append((key, at, layout))
                matrices.append(matrix)
    if not keys:
        return [], np.zeros((0, 4, 4))
    return keys[:MAX_WINDOWS], np.array(matrices[:MAX_WINDOWS])


def layout_matrix(part, layout):
    if layout == "columns":
        return part.reshape(4, 4).T
    if layout == "rows":
        return part.reshape(4, 4)
    return np.vstack([part.reshape(3, 4), [0, 0, 0, 1]])


def window_matrix(constants, place):
    key, at, layout = place
    for name, data in constants:
        if name == key:
            count = 12 if layout == "rows3" else 16
            part = np.frombuffer(data, "<f4", count, at * 4).astype(float)
            return layout_matrix(part, layout)
    return None


def sample_points(points, clip):
    """Returns up to twelve points far apart."""
    chosen = [int(np.argmax(np.abs(points[:, :3]).sum(1)))]
    distance = np.full(len(points), np.inf)
    while len(chosen) < min(12, len(points)):
        distance = np.minimum(distance, np.abs(points[:, :3] - points[chosen[-1], :3]).sum(1))
        chosen.append(int(np.argmax(distance)))
    return points[chosen], clip[chosen]


def scores(matrices, points, clip):
    """Relative error of rows x, y and w of each matrix."""
    out = np.einsum("nij,pj->npi", matrices, points)
    scale = np.maximum(np.abs(clip).max(0), 1e-30)
    return (np.abs(out - clip) / scale)[:, :, [0, 1, 3]].max((1, 2))


def products(points, clip, constants):
    """Searches windows and products of two and three windows that take points to clip positions.

    Returns lists of places, best first, with errors: [(error, (place, ...))].
    """
    keys, matrices = windows(constants)
    points, clip = sample_points(points, clip)
    found = []
    if not keys:
        return found
    for i, error in enumerate(scores(matrices, points, clip)):
        if error < MATRIX_RESIDUAL:
            found.append((error, (keys[i],)))
    affine = np.abs(matrices[:, 3] - [0, 0, 0, 1]).max(1) < 1e-6
    right = np.nonzero(affine)[0]
    moved = np.einsum("nij,pj->npi", matrices[right], points)  # points after the rightmost matrix
    scale = np.maximum(np.abs(clip).max(0), 1e-30)
    xyw = [0, 1, 3]

    def search(lefts, names):
        for r in range(len(right)):
            out = np.einsum("nij,pj->npi", lefts[:, xyw], moved[r])
            error = (np.abs(out - clip[:, xyw]) / scale[xyw]).max((1, 2))
            for i in np.nonzero(error < MATRIX_RESIDUAL)[0]:
                found.append((error[i], names(i) + (keys[right[r]],)))

    search(matrices, lambda i: (keys[i],))
    if not any(len(f[1]) == 2 for f in found):
        # The middle matrix is a view matrix: affine too.
        views = right
        for a in range(len(keys)):
            pairs = np.einsum("ij,njk->nik", matrices[a], matrices[views])
            search(pairs, lambda i, a=a: (keys[a], keys[views[i]]))
            if len(found) > 64:
                break
    return sorted(found, key=lambda f: f[0])


def centre_of_projection(matrix):
    """Returns the null vector of rows x, y, w, scaled to length 1, and whether it lies at infinity."""
    rows = matrix[[0, 1, 3]] / np.linalg.norm(matrix[[0, 1, 3], :], axis=1, keepdims=True)
    _, _, right = np.linalg.svd(rows)
    centre = right[3]
    at_infinity = np.linalg.norm(centre[:3]) > 1e5 * abs(centre[3])
    return centre, at_infinity


def light_of(matrix, reversed_, negative_one):
    """Returns ("directional", direction) or ("local", position, axis) of a light's matrix."""
    centre, at_infinity = centre_of_projection(matrix)
    inverse = np.linalg.inv(matrix)
    near, far = (-1.0 if negative_one else 0.0), 1.0
    if reversed_:
        near, far = far, near
    ends = [inverse @ np.array([0, 0, z, 1.0]) for z in (near, far)]
    if at_infinity:
        direction = centre[:3] / np.linalg.norm(centre[:3])
        # Of two points on one ray the nearer one lies towards the light.
        steps = ends[1][:3] / ends[1][3] - ends[0][:3] / ends[0][3]
        if np.dot(direction, steps) < 0:
            direction = -direction
        return "directional", direction
    position = centre[:3] / centre[3]
    axis = matrix[3, :3] / np.linalg.norm(matrix[3, :3])
    return "local", position, axis


def is_mirrored(matrix, kind):
    """Returns whether a light's map is a mirror image, which shows the opposite winding. @param kind see light_of()"""
    towards = -kind[-1]
    return bool(np.linalg.det([matrix[0, :3], matrix[1, :3], towards]) < 0)
