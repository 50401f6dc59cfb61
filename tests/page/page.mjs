// SPDX-License-Identifier: BSD-3-Clause
// Opens pages of `abrdf report` and `abrdf preview --html` in headless Chromium.
//   node page.mjs PROGRAM
// Exit 77, which ctest takes for a skip, where Chromium or the npm packages are absent.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";

const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((file) => existsSync(file));
let playwright, axe;
try {
    playwright = await import("playwright-core");
    axe = readFileSync(new URL("node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
} catch {
    console.log("skipped: run npm ci in tests/page first");
    process.exit(77);
}
if (!chromium) {
    console.log("skipped: Debian's package chromium is absent");
    process.exit(77);
}

const program = process.argv[2];
const folder = mkdtempSync(join(tmpdir(), "abrdf-page-"));
const abrdf = (...words) => execFileSync(program, [...words, "-q"], {cwd: folder, env: {...process.env, OCIO: ""}});
const SIZE = 128;

/** A small batch: one cloth, measured and reconstructed, and reports of every command. */
function makeBatch() {
    abrdf("demo", "cloth.zip", "--size", "8", "--hdr");
    abrdf("convert", "cloth.zip", "-o", "a.exr", "--method", "published", "--report", "convert.json");
    abrdf("convert", "cloth.zip", "-o", "b.exr", "--method", "measured");
    abrdf("convert", "cloth.zip", "-o", "c.exr", "--method", "published", "--grid", "utia288");
    execFileSync(program, ["evaluate", "cloth.zip", "--method", "measured,published", "--report", "evaluate.json", "-q"],
        {cwd: folder, stdio: "ignore"});
    const results = [{method: "other", input: "cloth.zip", samples: 52, delta_e: 1.5, microseconds_per_abrdf: 70},
        {method: "other", input: "cloth.zip", samples: 204, delta_e: 0.7, microseconds_per_abrdf: 300}];
    writeFileSync(join(folder, "chart.json"), JSON.stringify({command: "chart", results}));
    writeFileSync(join(folder, "stress.json"), JSON.stringify({command: "stress", results: [
        {case: "noise </script><b>", method: "published", breakdown: 0.05}, {case: "noise </script><b>", method: "other", breakdown: null}]}));
    abrdf("report", ".", "-o", "page.html", "--title", "A <batch> & more");
    abrdf("preview", "a.exr", "-o", "studio.png", "--size", SIZE + "x" + SIZE);
    abrdf("preview", "c.exr", "-o", "utia.png", "--size", SIZE + "x" + SIZE, "--environment", "sky", "--turn", "50");
    abrdf("preview", "b.exr", "-o", "light.png", "--size", SIZE + "x" + SIZE, "--light", "-30,35", "--camera", "20,15",
        "--view", "Un-tone-mapped", "--exposure", "4");
}

/** CIE 1976 Delta E of two sRGB codes. */
function deltaE(a, b) {
    const lab = ([r, g, b]) => {
        const light = [r, g, b].map((c) => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
        const rows = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        const [x, y, z] = rows.map((row) => {
            const t = row.reduce((sum, m, i) => sum + m * light[i], 0) / row.reduce((sum, m) => sum + m, 0);
            return t > (6 / 29) ** 3 ? Math.cbrt(t) : t / (3 * (6 / 29) ** 2) + 4 / 29;
        });
        return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
    };
    const p = lab(a), q = lab(b);
    return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

function meanDeltaE(a, b) {
    assert.equal(a.length, b.length);
    let sum = 0;
    for (let i = 0; i < a.length; i += 4) sum += deltaE(a.slice(i, i + 3), b.slice(i, i + 3));
    return sum / (a.length / 4);
}

const changed = (a, b) => a.reduce((count, value, i) => count + (value !== b[i] ? 1 : 0), 0);

async function opened(context, file, messages) {
    const page = await context.newPage();
    page.on("console", (m) => { if (m.type() !== "log") messages.push(m.text()); });
    page.on("pageerror", (e) => messages.push(e.message));
    page.on("request", (r) => { if (!/^(file|data|blob):/.test(r.url())) messages.push("asks for " + r.url()); });
    await page.goto("file://" + join(folder, file));
    return page;
}

const pixels = (page, changes) => page.evaluate(([size, c]) => window.abrdfViewer.pixels(size, c), [SIZE, changes]);

async function picture(page, file) {
    const uri = "data:image/png;base64," + readFileSync(join(folder, file)).toString("base64");
    return page.evaluate(async (src) => {
        const image = new Image();
        image.src = src;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0);
        return [...context.getImageData(0, 0, image.width, image.height).data];
    }, uri);
}

async function accessible(page, what) {
    await page.addScriptTag({content: axe});
    const result = await page.evaluate(() => window.axe.run(document));
    const faults = result.violations.map((v) => v.id + ": " + v.nodes.map((n) => n.target).join(" "));
    assert.deepEqual(faults, [], what);
}

const tests = {
    async "the sphere is the one of abrdf preview, on average within 2 Delta E"(page) {
        const cases = [["studio.png", {material: 0, light: 0, wipe: 0}],
            ["utia.png", {material: 1, light: 1, wipe: 0, lightAzimuth: 50}],
            ["light.png", {material: 0, light: 2, wipe: 1, tone: 0, exposure: 2, lightAzimuth: -30, lightElevation: 35,
                cameraAzimuth: 20, cameraElevation: 15}]];
        for (const [file, state] of cases) {
            const off = meanDeltaE(await pixels(page, state), await picture(page, file));
            console.log("    " + file + ": mean Delta E " + off.toFixed(3));
            assert.ok(off < 2, file + " is off by " + off);
        }
    },
    async "dragging turns the camera, and with the other choice the light"(page) {
        const canvas = page.locator("#sphere");
        await page.getByLabel("One light").check();
        const box = await canvas.boundingBox();
        const drag = async () => {
            await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
            await page.mouse.down();
            await page.mouse.move(box.x + box.width / 2 + 90, box.y + box.height / 2 - 40, {steps: 3});
            await page.mouse.up();
        };
        for (const what of ["camera", "light"]) {
            await page.getByLabel("the " + what).check();
            const before = await pixels(page, {});
            const state = await page.evaluate(() => ({...window.abrdfViewer.state}));
            await drag();
            const after = await page.evaluate(() => ({...window.abrdfViewer.state}));
            assert.notEqual(after[what + "Azimuth"], state[what + "Azimuth"]);
            assert.ok(changed(before, await pixels(page, {})) > 1000, what);
        }
    },
    async "sliders and keys change the picture and say their value in words"(page) {
        await page.getByRole("button", {name: "Reset"}).click();
        for (const id of ["exposure", "tone", "wipe"]) {
            const before = await pixels(page, {});
            const slider = page.locator("#" + id);
            await slider.focus();
            for (let i = 0; i < 20; ++i) await page.keyboard.press("ArrowLeft");
            assert.ok(changed(before, await pixels(page, {})) > 500, id);
            assert.equal(await slider.getAttribute("aria-valuetext"), await page.locator("#" + id + "-value").textContent());
        }
        await page.locator("#sphere").focus();
        const before = await pixels(page, {});
        await page.keyboard.press("ArrowRight");
        await page.keyboard.press("Shift+ArrowUp");
        await page.keyboard.press("PageUp");
        const state = await page.evaluate(() => window.abrdfViewer.state);
        assert.equal(state.cameraAzimuth, 5);
        assert.equal(state.lightElevation, 45);
        assert.ok(changed(before, await pixels(page, {})) > 500);
        await page.getByRole("button", {name: "Reset"}).click();
    },
    async "the wipe shows the measurement on its left, the overlay their Delta E"(page) {
        const left = await pixels(page, {material: 0, wipe: 1});
        const right = await pixels(page, {material: 0, wipe: 0});
        const both = await pixels(page, {material: 0, wipe: 0.5});
        for (let i = 0; i < both.length; i += 4) {
            const source = (i / 4) % SIZE < SIZE / 2 ? left : right;
            assert.equal(both[i], source[i]);
        }
        assert.ok(changed(left, right) > 1000);
        await page.locator("#difference").check();
        assert.ok(changed(right, await pixels(page, {})) > 1000);
        assert.ok(await page.locator("#difference-bar").isVisible());
        await page.locator("#difference").uncheck();
    },
    async "the list has every reconstruction, tables sort by a click or Enter, text stays text"(page) {
        assert.equal(await page.locator("#materials input").count(), 2);
        assert.equal(await page.title(), "A <batch> & more");
        assert.equal(await page.locator("h1").textContent(), "A <batch> & more");
        const table = page.locator("table").first();
        const column = async () => (await table.locator("tbody tr > :nth-child(6)").allTextContents()).map(Number);
        const head = table.locator("thead th").nth(5);
        const sorting = () => page.waitForTimeout(100);
        await head.click();
        await sorting();
        const sorted = await column();
        assert.deepEqual(sorted, [...sorted].sort((a, b) => a - b));
        await head.focus();
        await page.keyboard.press("Enter");
        await sorting();
        assert.deepEqual(await column(), [...sorted].reverse());
        assert.equal(await page.locator("table.matrix tbody th").textContent(), "noise </script><b>");
        assert.ok(await page.locator("#chart canvas").isVisible());
    },
    async "it passes axe, dark and light, with all of it open"(page) {
        for (const details of await page.locator("details").all()) await details.evaluate((d) => { d.open = true; });
        for (const colorScheme of ["dark", "light"]) {
            await page.emulateMedia({colorScheme});
            await accessible(page, colorScheme);
        }
        await page.getByRole("button", {name: "Dark page"}).click();
        await accessible(page, "chosen by the button");
    },
    async "on a phone nothing is wider than the screen"(page) {
        await page.setViewportSize({width: 360, height: 740});
        await page.waitForTimeout(200);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 360);
        assert.ok((await page.locator("#sphere").boundingBox()).width > 300);
        await accessible(page, "phone");
    },
};

const FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"];
let failed = 0;
let context;
async function run(name, test) {
    try {
        await test();
        console.log("ok: " + name);
    } catch (error) {
        ++failed;
        console.log("FAILED: " + name + "\n" + (error.stack || error));
    }
}
try {
    makeBatch();
    const launch = (flags) => playwright.chromium.launchPersistentContext(mkdtempSync(join(folder, "profile-")),
        {executablePath: chromium, headless: true, args: [...FLAGS, ...flags], viewport: {width: 860, height: 900}});
    context = await launch([]);
    const messages = [];
    const page = await opened(context, "page.html", messages);
    await page.waitForFunction(() => window.abrdfViewer, null, {timeout: 60000});
    for (const [name, test] of Object.entries(tests)) await run(name, () => test(page));
    await run("no console message, no request to a network", () => assert.deepEqual(messages, []));
    await run("the page is small", () => assert.ok(statSync(join(folder, "page.html")).size < 2e6));
    await context.close();

    context = await launch(["--disable-3d-apis"]);
    const still = await opened(context, "page.html", []);
    await run("without WebGL the pictures stand in", async () => {
        assert.ok(await still.locator("#pictures img").first().isVisible());
        assert.ok(!await still.locator("#viewer").isVisible());
        assert.equal(await still.locator("#pictures img").count(), 4);
        await accessible(still, "still pictures");
    });
} finally {
    await context?.close();
    rmSync(folder, {recursive: true, force: true});
}
console.log(failed ? failed + " failed" : "all passed");
process.exit(failed ? 1 : 0);
