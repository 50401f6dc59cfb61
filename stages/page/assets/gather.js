// The environment as the material's own light directions see it, at nodes of longitude and latitude
// of the sphere: what GatheredLight does in the program.
const NODES_WIDE = 91, NODES_HIGH = 46;

/** The light directions among which a direction (x, y, z) lies: calls add(index, weight). */
function eachWeight(rings, x, y, z, add) {
    const sine = Math.hypot(x, y);
    const theta = Math.atan2(sine, z);
    const phi = sine > 0 ? Math.atan2(y, x) : 0;
    let above = 0;
    while (above < rings.length && rings[above][0] < theta) ++above;
    const lower = rings[Math.max(0, above - 1)];
    const upper = rings[Math.min(above, rings.length - 1)];
    const gap = upper[0] - lower[0];
    const t = gap > 0 ? (theta - lower[0]) / gap : 0;
    for (const [ring, share] of [[lower, 1 - t], [upper, t]]) {
        if (share <= 0) continue;
        const [, phi0, count, first] = ring;
        const turns = (phi - phi0) / (2 * Math.PI);
        const place = (turns - Math.floor(turns)) * count;
        const before = Math.min(Math.floor(place), count - 1);
        add(first + before, share * (1 - (place - before)));
        add(first + (before + 1) % count, share * (place - before));
    }
}

/** The profile of a table at a half angle in degrees, as LobeProfile of the program has it. */
function lobeAt(table, degrees) {
    const c = table.lobe, places = c.length;
    const place = Math.log((degrees + 2) / 2) / Math.log(46) * (places - 1);
    const i = Math.min(Math.floor(place), places - 2), t = place - i, u = 1 - t;
    return Math.exp((u ** 3 * c[i > 0 ? i - 1 : 1] + (3 * t ** 3 - 6 * t * t + 4) * c[i]
        + (3 * u ** 3 - 6 * u * u + 4) * c[i + 1] + t ** 3 * c[Math.min(i + 2, places - 1)]) / 6);
}

/** Unit vectors of all directions of rings, in the table's order. */
function vectorsOf(rings) {
    const vectors = [];
    for (const [theta, phi0, count, first] of rings) {
        for (let k = 0; k < count; ++k) {
            const phi = phi0 + 2 * Math.PI * k / count;
            vectors[first + k] = [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
        }
    }
    return vectors;
}

function floatOfHalf(bits) {
    const exponent = bits >> 10 & 31, fraction = bits & 1023;
    const size = exponent ? 2 ** (exponent - 15) * (1 + fraction / 1024) : 2 ** -24 * fraction;
    return bits & 0x8000 ? -size : size;
}

/** Float32Array [light][view][R, G, B, 1 / profile]. */
function withProfile(table, halves) {
    const out = new Float32Array(4 * table.lights * table.views);
    const lights = vectorsOf(table.lightRings), views = vectorsOf(table.viewRings);
    let at = 0, from = 0;
    for (const l of lights) {
        for (const v of views) {
            for (let c = 0; c < 3; ++c) out[at++] = floatOfHalf(halves[from++]);
            const half = Math.atan2(Math.hypot(l[0] + v[0], l[1] + v[1]), l[2] + v[2]);
            out[at++] = 1 / lobeAt(table, half * 180 / Math.PI);
        }
    }
    return out;
}

/** Float32Array [light][latitude][longitude][RGBA]; the last meridian repeats the first. */
function gather(table, lights) {
    const plane = NODES_WIDE * NODES_HIGH * 4;
    const out = new Float32Array(table.lights * plane);
    const last = Math.cos(table.lightRings[table.lightRings.length - 1][0]);
    for (let row = 0; row < NODES_HIGH; ++row) {
        const latitude = Math.PI * (0.5 - row / (NODES_HIGH - 1));
        for (let column = 0; column < NODES_WIDE; ++column) {
            const longitude = 2 * Math.PI * (column / (NODES_WIDE - 1) - 0.5);
            const cl = Math.cos(longitude), sl = Math.sin(longitude);
            const ca = Math.cos(latitude), sa = Math.sin(latitude);
            // x: along the parallel; y: to the north; n: outwards.
            const n = [ca * sl, sa, ca * cl], yAxis = [-sa * sl, ca, -sa * cl];
            const at = (row * NODES_WIDE + column) * 4;
            for (let i = 0; i < lights.length; i += 6) {
                const dx = lights[i], dy = lights[i + 1], dz = lights[i + 2];
                const z = dx * n[0] + dy * n[1] + dz * n[2];
                if (z <= 0) continue;
                const x = dx * cl - dz * sl;
                const y = dx * yAxis[0] + dy * yAxis[1] + dz * yAxis[2];
                const factor = !table.cosineInside ? z : z < last ? z / last : 1;
                eachWeight(table.lightRings, x, y, z, (index, weight) => {
                    const k = index * plane + at;
                    out[k] += weight * factor * lights[i + 3];
                    out[k + 1] += weight * factor * lights[i + 4];
                    out[k + 2] += weight * factor * lights[i + 5];
                });
            }
        }
    }
    return out;
}
