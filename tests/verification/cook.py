"""Cook's membrane in plane strain by a program of its own, in two dimensions: triangles, quadratic in displacements and
linear in the pressure (Taylor and Hood), of the stress 2 mu strain + p. It shares nothing with the program's tets but
the problem. Meshes are divided towards the corners of the clamped edge, where the stress is infinite or nearly so: an
edge that ends there is cut near it, at `share` of its length (Bacuta, Nistor and Zikatanov, Numer. Math. 100, 2005)."""
import numpy as np
from scipy.optimize import brentq
from scipy.sparse import bmat, coo_matrix
from scipy.sparse.linalg import spsolve

CORNERS = np.array([(0.0, 0.0), (48.0, 44.0), (48.0, 60.0), (0.0, 44.0)])
SINGULAR = (0, 3)  # of the coarse mesh's points
FORCE = 100.0      # along y, spread evenly over the right edge


def exponent(nu):
    """Displacements at the upper left corner grow as (distance)^exponent: M. L. Williams, J. Appl. Mech. 19, 1952, of
    a corner with a clamped and a free edge."""
    angle = np.pi / 2 + np.arctan2(16.0, 48.0)
    k = 3.0 - 4.0 * nu

    def missed(x):
        return np.sin(x * angle) ** 2 - ((k + 1.0) ** 2 - 4.0 * x**2 * np.sin(angle) ** 2) / (4.0 * k)

    return brentq(missed, 0.3, 0.8)


def coarse():
    """Points and triangles: 4 × 2 quadrangles, each cut along a diagonal."""
    points, triangles = [tuple(c) for c in CORNERS], []
    number = {(0, 0): 0, (4, 0): 1, (4, 2): 2, (0, 2): 3}
    for j in range(3):
        for i in range(5):
            x, y = i / 4.0, j / 2.0
            place = (1 - y) * ((1 - x) * CORNERS[0] + x * CORNERS[1]) + y * ((1 - x) * CORNERS[3] + x * CORNERS[2])
            if (i, j) not in number:
                number[i, j] = len(points)
                points.append(tuple(place))
    for j in range(2):
        for i in range(4):
            a, b, c, d = (number[k] for k in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            triangles += [(a, b, c), (a, c, d)] if j == 0 else [(a, b, d), (b, c, d)]
    return np.array(points), np.array(triangles)


def divide(points, triangles, share):
    """Each triangle in four."""
    points, middle, divided = [tuple(p) for p in points], {}, []

    def cut(a, b):
        a, b = min(a, b), max(a, b)
        if (a, b) not in middle:
            ends = np.array(points[a]), np.array(points[b])
            at = share if a in SINGULAR and b not in SINGULAR else 1 - share if b in SINGULAR and a not in SINGULAR else 0.5
            middle[a, b] = len(points)
            points.append(tuple(ends[0] + at * (ends[1] - ends[0])))
        return middle[a, b]

    for a, b, c in triangles:
        ab, bc, ca = cut(a, b), cut(b, c), cut(c, a)
        divided += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.array(points), np.array(divided)


def mesh(divisions, share):
    points, triangles = coarse()
    for _ in range(divisions):
        points, triangles = divide(points, triangles, share)
    return points, triangles


def with_middles(points, triangles):
    """Six nodes for each triangle: corners, then the middles of edges 01, 12, 20."""
    middle, nodes, places = {}, [], [tuple(p) for p in points]
    for t in triangles:
        six = list(t)
        for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(places)
                places.append(tuple((points[a] + points[b]) / 2))
            six.append(middle[key])
        nodes.append(six)
    return np.array(places), np.array(nodes)


# Degree 4, six points (Dunavant 1985).
AT = np.array([(a, a, 1 - 2 * a) for a in (0.445948490915965, 0.091576213509771)])
AT = np.array([np.roll(p, k) for p in AT for k in range(3)])
WEIGHT = np.repeat((0.223381589678011, 0.109951743655322), 3)


def assemble(places, nodes, mu):
    """A of 2 mu strain : strain, B of the pressure's work, M the pressures' mass."""
    corner = places[nodes[:, :3]]
    edge = np.stack([corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]], axis=1)
    area = 0.5 * np.linalg.det(edge)
    of_barycentric = np.linalg.inv(edge).transpose(0, 2, 1)  # gradients of the 2nd and 3rd
    gradient = np.concatenate([-of_barycentric.sum(axis=1, keepdims=True), of_barycentric], axis=1)
    a = np.zeros((len(nodes), 12, 12))
    b = np.zeros((len(nodes), 3, 12))
    for at, weight in zip(AT, WEIGHT):
        g = [(4 * at[i] - 1) * gradient[:, i] for i in range(3)]
        g += [4 * (at[i] * gradient[:, j] + at[j] * gradient[:, i]) for i, j in ((0, 1), (1, 2), (2, 0))]
        strain = np.zeros((len(nodes), 3, 12))  # 11, 22, 12 √2
        for n in range(6):
            strain[:, 0, 2 * n] = g[n][:, 0]
            strain[:, 1, 2 * n + 1] = g[n][:, 1]
            strain[:, 2, 2 * n] = g[n][:, 1] / np.sqrt(2)
            strain[:, 2, 2 * n + 1] = g[n][:, 0] / np.sqrt(2)
        a += (2 * mu * weight * area)[:, None, None] * np.einsum("eki,ekj->eij", strain, strain)
        b += (weight * area)[:, None, None] * at[None, :, None] * (strain[:, 0] + strain[:, 1])[:, None, :]
    mass = area[:, None, None] * (np.ones((3, 3)) + np.eye(3)) / 12.0
    unknown = np.stack([2 * nodes, 2 * nodes + 1], axis=2).reshape(len(nodes), 12)

    def gather(values, rows, columns, shape):
        i = np.broadcast_to(rows[:, :, None], values.shape)
        j = np.broadcast_to(columns[:, None, :], values.shape)
        return coo_matrix((values.ravel(), (i.ravel(), j.ravel())), shape=shape).tocsr()

    n, m = 2 * len(places), nodes[:, :3].max() + 1
    pressure = nodes[:, :3]
    return gather(a, unknown, unknown, (n, n)), gather(b, pressure, unknown, (m, n)), gather(mass, pressure, pressure, (m, m))


def load(places, nodes):
    """Simpson's weights along the right edge."""
    force = np.zeros(2 * len(places))
    for six in nodes:
        for a, m, b in ((0, 3, 1), (1, 4, 2), (2, 5, 0)):
            if abs(places[six[a], 0] - 48.0) < 1e-9 and abs(places[six[b], 0] - 48.0) < 1e-9:
                share = abs(places[six[a], 1] - places[six[b], 1]) / 16.0 * FORCE
                force[2 * six[[a, m, b]] + 1] += share * np.array([1, 4, 1]) / 6.0
    return force


def solve(young, nu, divisions, share):
    """Mean displacement of the right edge along y, and that of its upper end."""
    places, nodes = with_middles(*mesh(divisions, share))
    mu = young / (2 * (1 + nu))
    looseness = (1 + nu) * (1 - 2 * nu) / (young * nu)
    a, b, mass = assemble(places, nodes, mu)
    force = load(places, nodes)
    free = np.flatnonzero(np.repeat(places[:, 0] > 1e-9, 2))
    system = bmat([[a[free][:, free], b[:, free].T], [b[:, free], -looseness * mass]], format="csc")
    u = np.zeros(2 * len(places))
    u[free] = spsolve(system, np.concatenate([force[free], np.zeros(mass.shape[0])]))[: len(free)]
    return force @ u / FORCE, u[2 * 2 + 1]


def reference(young, nu, most=4):
    """What the mean displacement goes to on ever finer meshes, graded to hide the corners; its order, and what it was."""
    share = 0.5 ** (2.0 / exponent(nu))
    values = [solve(young, nu, n, share)[0] for n in range(most - 2, most + 1)]
    rate = np.log2((values[1] - values[0]) / (values[2] - values[1]))
    return values[2] + (values[2] - values[1]) / (2.0**rate - 1.0), rate, values


if __name__ == "__main__":
    for ratio in (0.3, 0.4999, 0.5):
        limit, order, found = reference(240.565, ratio, 5)
        print(f"nu = {ratio}: exponent {exponent(ratio):.4f}, mean displacement {limit:.9g}, order {order:.2f}, of {found}")
