"""Natural frequencies of the two bodies of lk-collision by finite elements, free of any support: reference for Table 2.

Eight-node quadrilaterals, plane stress, three by three Gauss points, consistent mass. Needs numpy and scipy.
Run:  python modes.py > modes.csv
"""
import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import eigsh

E, NU, RHO = 650.0, 0.3, 1000.0
D = E / (1 - NU**2) * np.array([[1, NU, 0], [NU, 1, 0], [0, 0, (1 - NU) / 2]])
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]], float)
GAUSS = [(-np.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (np.sqrt(0.6), 5 / 9)]


def shape(s, t):
    n, d = np.zeros(8), np.zeros((8, 2))
    for i, (a, b) in enumerate(CORNERS):
        if i < 4:
            n[i] = (1 + a * s) * (1 + b * t) * (a * s + b * t - 1) / 4
            d[i] = [a * (1 + b * t) * (2 * a * s + b * t) / 4, b * (1 + a * s) * (2 * b * t + a * s) / 4]
        elif a == 0:
            n[i] = (1 - s * s) * (1 + b * t) / 2
            d[i] = [-s * (1 + b * t), b * (1 - s * s) / 2]
        else:
            n[i] = (1 + a * s) * (1 - t * t) / 2
            d[i] = [a * (1 - t * t) / 2, -t * (1 + a * s)]
    return n, d


def element(x):
    k, m = np.zeros((16, 16)), np.zeros((16, 16))
    for s, ws in GAUSS:
        for t, wt in GAUSS:
            n, d = shape(s, t)
            jac = d.T @ x
            g = d @ np.linalg.inv(jac).T
            b = np.zeros((3, 16))
            b[0, 0::2], b[1, 1::2], b[2, 0::2], b[2, 1::2] = g[:, 0], g[:, 1], g[:, 1], g[:, 0]
            nn = np.zeros((2, 16))
            nn[0, 0::2], nn[1, 1::2] = n, n
            w = ws * wt * abs(np.linalg.det(jac))
            k += w * b.T @ D @ b
            m += w * RHO * nn.T @ nn
    return k, m


def grid(nu, nv, place, closed):
    """Elements on nu x nv cells of (u, v) in the unit square; closed joins u = 1 to u = 0."""
    nodes, ids, elements = [], {}, []

    def node(i, j):
        key = (i % (2 * nu) if closed else i, j)
        if key not in ids:
            ids[key] = len(nodes)
            nodes.append(place(key[0] / (2 * nu), j / (2 * nv)))
        return ids[key]

    for i in range(nu):
        for j in range(nv):
            a, b = 2 * i, 2 * j
            elements.append([node(*p) for p in [(a, b), (a + 2, b), (a + 2, b + 2), (a, b + 2), (a + 1, b), (a + 2, b + 1), (a + 1, b + 2), (a, b + 1)]])
    return np.array(nodes), elements


def frequencies(nodes, elements, count):
    n = 2 * len(nodes)
    rows, cols, ks, ms = [], [], [], []
    for e in elements:
        dofs = np.ravel([[2 * i, 2 * i + 1] for i in e])
        k, m = element(nodes[e])
        r, c = np.meshgrid(dofs, dofs, indexing="ij")
        rows.append(r.ravel()), cols.append(c.ravel()), ks.append(k.ravel()), ms.append(m.ravel())
    at = (np.concatenate(rows), np.concatenate(cols))
    k = sp.csc_matrix((np.concatenate(ks), at), (n, n))
    m = sp.csc_matrix((np.concatenate(ms), at), (n, n))
    values = eigsh(k, count + 3, m, sigma=-1e4, return_eigenvectors=False)
    return np.sqrt(np.sort(values)[3:]) / (2 * np.pi)


def annulus(u, v):
    r, a = 2.5e-4 + 2.5e-4 * v, -2 * np.pi * u
    return [r * np.cos(a), r * np.sin(a)]


if __name__ == "__main__":
    print("# Natural frequencies, Hz, of free bodies in plane stress: E 650 Pa, nu 0.3, rho 1000 kg/m^3; 8-node quadrilaterals (modes.py).")
    print("body,mesh,frequencies...")
    for cells in [(48, 6), (96, 12)]:
        f = frequencies(*grid(*cells, annulus, True), 12)
        print(f"annulus,{cells[0]}x{cells[1]}," + ",".join(f"{x:.2f}" for x in f))
    for cells in [(20, 10), (40, 20)]:
        f = frequencies(*grid(*cells, lambda u, v: [5e-4 * u, 2.5e-4 * v], False), 18)
        print(f"rectangle,{cells[0]}x{cells[1]}," + ",".join(f"{x:.2f}" for x in f))
