// The interactive sphere. `window.abrdfViewer` is its handle, for tests and for the curious.
const DATA = JSON.parse(document.getElementById("data").textContent);
const RADIANS = Math.PI / 180;
const element = (id) => document.getElementById(id);

function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
}

function makeViewer(canvas) {
    const gl = canvas.getContext("webgl2", {antialias: false, preserveDrawingBuffer: true});
    if (!gl || !DATA.materials.length) return null;

    function compiled(type, id) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, element(id).textContent.trim());
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
        return shader;
    }
    const program = gl.createProgram();
    gl.attachShader(program, compiled(gl.VERTEX_SHADER, "vertex-shader"));
    gl.attachShader(program, compiled(gl.FRAGMENT_SHADER, "fragment-shader"));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const places = {};
    const at = (name) => places[name] ??= gl.getUniformLocation(program, name);

    function texture(unit, target, filter, upload) {
        const made = gl.createTexture();
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(target, made);
        for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, filter], [gl.TEXTURE_MAG_FILTER, filter],
            [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
            [gl.TEXTURE_WRAP_R, gl.CLAMP_TO_EDGE]]) {
            gl.texParameteri(target, key, value);
        }
        upload();
        return made;
    }

    // Texture units: 0 and 1 the tables, 2 and 3 the gathered light, 4 the view.
    for (const [name, unit] of [["uTable0", 0], ["uTable1", 1], ["uGathered0", 2], ["uGathered1", 3], ["uView", 4]]) {
        gl.uniform1i(at(name), unit);
    }
    const side = DATA.view.side;
    texture(4, gl.TEXTURE_3D, gl.LINEAR, () => gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGB8, side, side, side, 0,
        gl.RGB, gl.UNSIGNED_BYTE, bytesOf(DATA.view.codes)));

    const environments = DATA.environments.map((e) => ({name: e.name, sun: e.sun, lights: new Float32Array(bytesOf(e.lights).buffer)}));
    const gatheredOf = new Map();  // Of a light grid and an environment.

    function bindTable(slot, table) {
        if (table.texture === undefined) {
            const halves = new Uint16Array(bytesOf(table.halves).buffer);
            const values = withProfile(table, halves);
            table.texture = texture(slot, gl.TEXTURE_2D, gl.NEAREST, () => gl.texImage2D(gl.TEXTURE_2D, 0,
                gl.RGBA32F, table.views, table.lights, 0, gl.RGBA, gl.FLOAT, values));
        }
        gl.activeTexture(gl.TEXTURE0 + slot);
        gl.bindTexture(gl.TEXTURE_2D, table.texture);
    }

    function bindGathered(slot, table, environment) {
        const key = JSON.stringify([table.lightRings, table.cosineInside, environment.name]);
        if (!gatheredOf.has(key)) {
            const values = gather(table, environment.lights);
            gatheredOf.set(key, texture(2 + slot, gl.TEXTURE_2D_ARRAY, gl.LINEAR, () => gl.texImage3D(
                gl.TEXTURE_2D_ARRAY, 0, gl.RGBA16F, NODES_WIDE, NODES_HIGH, table.lights, 0, gl.RGBA, gl.FLOAT, values)));
        }
        gl.activeTexture(gl.TEXTURE2 + slot);
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, gatheredOf.get(key));
    }

    function setTables(material, environment) {
        const rings = new Float32Array(4 * 16 * 4);
        const lobes = new Float32Array(64);
        const counts = [0, 0, 0, 0], lights = [0, 0], cosines = [1, 1];
        [material.reconstruction, material.measurement].forEach((table, slot) => {
            // A slot without a table of its own gets the other's, so that every sampler is complete.
            const filled = table || material.reconstruction || material.measurement;
            bindTable(slot, filled);
            if (environment) bindGathered(slot, filled, environment);
            [filled.lightRings, filled.viewRings].forEach((list, i) => {
                rings.set(list.flat(), (2 * slot + i) * 64);
                counts[2 * slot + i] = list.length;
            });
            lobes.set(filled.lobe, 32 * slot);
            lights[slot] = filled.lights;
            cosines[slot] = filled.cosineInside ? 1 : 0;
        });
        gl.uniform4fv(at("uRings"), rings);
        gl.uniform1fv(at("uLobes"), lobes);
        gl.uniform4i(at("uRingCounts"), ...counts);
        gl.uniform2i(at("uLightCounts"), ...lights);
        gl.uniform2i(at("uCosineInside"), ...cosines);
    }

    const unit = (azimuth, elevation) => [Math.cos(elevation * RADIANS) * Math.sin(azimuth * RADIANS),
        Math.sin(elevation * RADIANS), Math.cos(elevation * RADIANS) * Math.cos(azimuth * RADIANS)];

    function draw(state) {
        const material = DATA.materials[state.material];
        const environment = environments[state.light] || null;
        setTables(material, environment);
        const half = 12.5 * RADIANS;  // The camera of `abrdf preview`.
        const towards = unit(state.cameraAzimuth, state.cameraElevation);
        const a = state.cameraAzimuth * RADIANS;
        const right = [Math.cos(a), 0, -Math.sin(a)];
        const up = [towards[1] * right[2] - towards[2] * right[1], towards[2] * right[0] - towards[0] * right[2],
            towards[0] * right[1] - towards[1] * right[0]];
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.uniform2f(at("uSize"), canvas.width, canvas.height);
        gl.uniformMatrix3fv(at("uCamera"), false, [...right, ...up, ...towards]);
        gl.uniform1f(at("uDistance"), 1.06 / Math.sin(half));
        gl.uniform1f(at("uHalfAngle"), Math.tan(half));
        const sun = environment?.sun;
        const c = Math.cos(state.lightAzimuth * RADIANS), s = Math.sin(state.lightAzimuth * RADIANS);
        gl.uniform3fv(at("uLight"), sun ? [c * sun[0] + s * sun[2], sun[1], c * sun[2] - s * sun[0]]
            : unit(state.lightAzimuth, state.lightElevation));
        gl.uniform3fv(at("uStrength"), sun ? sun.slice(3) : environment ? [0, 0, 0] : [1, 1, 1]);
        gl.uniform1i(at("uEnvironment"), environment ? 1 : 0);
        gl.uniform1f(at("uTurn"), state.lightAzimuth / 360);
        gl.uniform1f(at("uExposure"), 2 ** state.exposure);
        gl.uniform1f(at("uTone"), state.tone);
        gl.uniform1f(at("uWipe"), state.wipe);
        gl.uniform1i(at("uShowDifference"), state.difference ? 1 : 0);
        gl.uniform1i(at("uHasReconstruction"), material.reconstruction ? 1 : 0);
        gl.uniform1i(at("uHasMeasurement"), material.measurement ? 1 : 0);
        gl.uniform3fv(at("uBackground"), DATA.background);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    return {gl, draw};
}

const INITIAL = {
    material: 0, light: 0, exposure: Math.log2(DATA.exposure), tone: 1, wipe: 0.5, difference: false,
    cameraAzimuth: 0, cameraElevation: 0, lightAzimuth: 0, lightElevation: 40, drag: "camera",
};

function startViewer() {
    const canvas = element("sphere");
    let viewer = null;
    try {
        viewer = makeViewer(canvas);
    } catch (error) {
        element("no-webgl").textContent += " It could not be started: " + error.message;
    }
    if (!viewer) return;
    element("viewer").hidden = false;
    element("pictures").hidden = true;
    const state = {...INITIAL};
    let asked = false, coarse = false, slow = false, settle = 0;

    function fit() {
        const wanted = Math.min(900, Math.round(canvas.clientWidth * Math.min(2, window.devicePixelRatio || 1)));
        const size = Math.max(64, coarse && slow ? Math.round(wanted / 2) : wanted);
        if (canvas.width !== size) canvas.width = canvas.height = size;
    }
    function paint() {
        asked = false;
        fit();
        const before = performance.now();
        viewer.draw(state);
        if (coarse) {
            // Waits for the picture, to know whether this machine needs a coarser one while it moves.
            viewer.gl.readPixels(0, 0, 1, 1, viewer.gl.RGBA, viewer.gl.UNSIGNED_BYTE, new Uint8Array(4));
            if (performance.now() - before > 60) slow = true;
        }
    }
    function ask() {
        show();
        if (asked) return;
        asked = true;
        requestAnimationFrame(paint);
    }
    function moving() {
        coarse = true;
        clearTimeout(settle);
        settle = setTimeout(() => { coarse = false; ask(); }, 200);
        ask();
    }

    const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
    const turn = (x) => ((x + 180) % 360 + 360) % 360 - 180;
    function move(what, right, up) {
        state[what + "Azimuth"] = turn(state[what + "Azimuth"] + right);
        state[what + "Elevation"] = clamp(state[what + "Elevation"] + up, -89, 89);
        moving();
    }

    const sliders = {"exposure": "exposure", "tone": "tone", "wipe": "wipe", "camera-azimuth": "cameraAzimuth",
        "camera-elevation": "cameraElevation", "light-azimuth": "lightAzimuth", "light-elevation": "lightElevation"};
    const texts = {
        "exposure": (v) => (v >= 0 ? "+" : "\u2212") + Math.abs(v).toFixed(1) + " stops",
        "tone": (v) => v <= 0 ? "plain sRGB" : v >= 1 ? DATA.view.name : Math.round(100 * v) + " % " + DATA.view.name,
        "wipe": (v) => Math.round(100 * v) + " %",
    };
    function show() {
        for (const [id, key] of Object.entries(sliders)) {
            element(id).value = state[key];
            const text = (texts[id] || ((v) => Math.round(v) + "\u00B0"))(state[key]);
            element(id + "-value").textContent = text;
            element(id).setAttribute("aria-valuetext", text);
        }
        element("difference").checked = state.difference;
        const material = DATA.materials[state.material];
        const both = Boolean(material.reconstruction && material.measurement);
        element("wipe-row").hidden = !both;
        element("difference-row").hidden = !both;
        const wiping = both && !state.difference;
        element("divider").hidden = !wiping || state.wipe <= 0 || state.wipe >= 1;
        element("divider").style.left = 100 * state.wipe + "%";
        element("left-side").hidden = !(wiping && state.wipe > 0) && (both || !material.measurement);
        element("right-side").hidden = !(wiping && state.wipe < 1) && (both || !material.reconstruction);
        element("difference-bar").hidden = !(both && state.difference);
        canvas.setAttribute("aria-label", "Sphere of " + material.name + ", " + material.caption);
        for (const [name, value] of [["material", state.material], ["light", state.light], ["drag", state.drag]]) {
            const radio = document.querySelector('input[name="' + name + '"][value="' + value + '"]');
            if (radio) radio.checked = true;
        }
    }

    function addRadios(list, name, entries) {
        entries.forEach(([value, text, more]) => {
            const label = document.createElement("label");
            const input = document.createElement("input");
            Object.assign(input, {type: "radio", name, value});
            const words = document.createElement("span");
            words.textContent = text;
            if (more) words.append(" ", Object.assign(document.createElement("small"), {textContent: more}));
            label.append(input, words);
            list.append(label);
        });
    }
    addRadios(element("materials"), "material", DATA.materials.map((m, i) => [i, m.name, m.caption]));
    addRadios(element("lights"), "light", [...DATA.environments.map((e, i) => [i, e.name]),
        [DATA.environments.length, "One light"]]);

    document.addEventListener("change", ({target}) => {
        if (target.name === "material") {
            state.material = Number(target.value);
            element("status").textContent = "Shown: " + DATA.materials[state.material].name;
        } else if (target.name === "light") {
            state.light = Number(target.value);
        } else if (target.name === "drag") {
            state.drag = target.value;
        } else if (target.id === "difference") {
            state.difference = target.checked;
        } else {
            return;
        }
        ask();
    });
    for (const [id, key] of Object.entries(sliders)) {
        element(id).addEventListener("input", () => { state[key] = Number(element(id).value); moving(); });
    }
    element("reset").addEventListener("click", () => {
        Object.assign(state, INITIAL, {material: state.material});
        ask();
    });

    let last = null;
    canvas.addEventListener("pointerdown", (event) => {
        last = [event.clientX, event.clientY];
        canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
        if (!last) return;
        const scale = 180 / canvas.clientWidth;
        const right = (event.clientX - last[0]) * scale, down = (event.clientY - last[1]) * scale;
        last = [event.clientX, event.clientY];
        const light = event.shiftKey || event.buttons === 2 ? true : state.drag === "light";
        // The sphere follows the hand, and so does the light.
        if (light) move("light", right, -down); else move("camera", -right, down);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { last = null; });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("keydown", (event) => {
        const steps = {ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5]};
        if (steps[event.key]) {
            move(event.shiftKey || state.drag === "light" ? "light" : "camera", ...steps[event.key]);
        } else if (event.key === "PageUp" || event.key === "PageDown") {
            state.exposure = clamp(state.exposure + (event.key === "PageUp" ? 0.5 : -0.5), -8, 8);
            moving();
        } else {
            return;
        }
        event.preventDefault();
    });
    canvas.addEventListener("webglcontextlost", () => {
        element("viewer").hidden = true;
        element("pictures").hidden = false;
    });
    window.addEventListener("resize", ask);

    window.abrdfViewer = {
        state,
        set(changes) { Object.assign(state, changes); show(); viewer.draw(state); },
        /** Codes of a square picture, row by row from the top, RGBA. */
        pixels(size, changes) {
            const before = canvas.width;
            canvas.width = canvas.height = size;
            viewer.draw({...state, ...changes});
            const bottomUp = new Uint8Array(4 * size * size);
            viewer.gl.readPixels(0, 0, size, size, viewer.gl.RGBA, viewer.gl.UNSIGNED_BYTE, bottomUp);
            canvas.width = canvas.height = before;
            ask();
            const rows = [];
            for (let y = size - 1; y >= 0; --y) rows.push(...bottomUp.subarray(4 * size * y, 4 * size * (y + 1)));
            return rows;
        },
    };
    ask();
}
startViewer();
