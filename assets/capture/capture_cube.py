"""Faces of point lights that the captured frame did not draw, because nothing casts into them."""
import numpy as np

# Directions of x, y and depth of each face of a cube map, in the order of OpenGL and Vulkan: rows of s and t, axis.
FACES = np.array([
    [[0, 0, -1], [0, -1, 0], [1, 0, 0]], [[0, 0, 1], [0, -1, 0], [-1, 0, 0]],
    [[1, 0, 0], [0, 0, 1], [0, 1, 0]], [[1, 0, 0], [0, 0, -1], [0, -1, 0]],
    [[1, 0, 0], [0, -1, 0], [0, 0, 1]], [[-1, 0, 0], [0, -1, 0], [0, 0, -1]]], float)
MOST_OFF = 1e-3


def turned_rows(matrix):
    """Returns the directions of x, y and w of a face of 90 degrees as unit rows, and the lengths; None: it is none."""
    rows = matrix[[0, 1, 3], :3]
    lengths = np.linalg.norm(rows, axis=1)
    if lengths.min() <= 0 or abs(lengths[0] / lengths[1] - 1) > MOST_OFF:
        return None
    # A face may be wider than 90 degrees, for filters.
    if not 0.5 < lengths[0] / lengths[2] < 1.01:
        return None
    unit = rows / lengths[:, None]
    return (unit, lengths) if np.abs(unit @ unit.T - np.eye(3)).max() < MOST_OFF else None


def order_of_faces(faces, layers):
    """Finds the first layer and the turn of the cube from faces that were drawn.

    @param faces [(layer, unit rows)] @param layers of the texture
    Returns (first layer, rows of all six faces), or None where the faces fit no order, or several.
    """
    found = []
    numbers = [layer for layer, _ in faces]
    for first in range(max(0, max(numbers) - 5), min(min(numbers), layers - 6) + 1):
        for flip in (1, -1):
            table = FACES * np.array([1, flip, 1])[:, None]
            turn = table[numbers[0] - first].T @ faces[0][1]
            rows = table @ turn
            if all(np.abs(rows[layer - first] - unit).max() < MOST_OFF for layer, unit in faces):
                found.append((first, rows))
    return found[0] if len(found) == 1 else None


def face_matrix(known, lengths, centre, rows):
    """Returns the matrix of a face from that of another face of the same light."""
    result = np.zeros((4, 4))
    result[[0, 1, 3], :3] = rows * lengths[:, None]
    result[[0, 1, 3], 3] = -(rows * lengths[:, None]) @ centre
    # The depth row is the same function of w on all faces.
    share = (known[2, :3] @ known[3, :3]) / (known[3, :3] @ known[3, :3])
    rest = known[2, 3] - share * known[3, 3]
    result[2] = share * result[3]
    result[2, 3] += rest
    return result


def missing_faces(group, layers):
    """Returns [(layer, matrix)] of faces that a point light's maps lack. @param group [(layer, matrix, centre)]"""
    if not 2 <= len(group) < 6 or layers < 6:
        return []
    faces = []
    for layer, matrix, _ in group:
        turned = turned_rows(matrix)
        if turned is None:
            return []
        faces.append((layer, turned[0]))
    if len({layer for layer, _ in faces}) < len(faces):
        return []
    order = order_of_faces(faces, layers)
    if order is None:
        return []
    first, rows = order
    layer, known, centre = group[0]
    lengths = turned_rows(known)[1]
    drawn = {layer for layer, _ in faces}
    return [(first + face, face_matrix(known, lengths, centre, rows[face])) for face in range(6)
            if first + face not in drawn]
