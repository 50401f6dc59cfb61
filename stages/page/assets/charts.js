// The error-time chart, and the page's two colour schemes.
const PALETTE = ["#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#d55e00", "#0072b2", "#b5a800", "#8c8c8c"];
let chart = null;

function isLight() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === "light" : matchMedia("(prefers-color-scheme: light)").matches;
}

function drawChart() {
    const points = DATA.points.filter((p) => p.microseconds > 0 && p.deltaE > 0);
    if (!points.length) return;
    element("chart-section").hidden = false;
    const methods = [...new Set(points.map((p) => p.method))];
    const times = [...new Set(points.map((p) => p.microseconds))].sort((a, b) => a - b);
    // A line joins one method's sizes on one material; colours are the methods'.
    const lines = [...new Set(points.map((p) => JSON.stringify([p.method, p.input])))].map((key) => {
        const [method, input] = JSON.parse(key);
        const own = points.filter((p) => p.method === method && p.input === input);
        return {method, input, values: times.map((t) => own.find((p) => p.microseconds === t)?.deltaE ?? null)};
    });
    // Outwards to 1, 2 or 5 times a power of ten.
    const nice = (x, up) => {
        const steps = [1, 2, 5, 10].map((s) => s * 10 ** Math.floor(Math.log10(x)));
        return up ? steps.find((s) => s >= x * 1.1) ?? steps[3] * 2 : [...steps].reverse().find((s) => s <= x / 1.1) ?? steps[0] / 2;
    };
    const range = (u, low, high) => [nice(low, false), nice(high, true)];
    const colorOf = (method) => PALETTE[methods.indexOf(method) % PALETTE.length];
    const text = isLight() ? "#1c1c1c" : "#eee", line = isLight() ? "#c4c4c4" : "#4d4d4d";
    const axis = {stroke: text, grid: {stroke: line, width: 1}, ticks: {stroke: line}, font: "13px system-ui, sans-serif"};
    const holder = element("chart");
    holder.replaceChildren();
    chart = new uPlot({
        width: Math.max(280, holder.clientWidth), height: 380,
        scales: {x: {time: false, distr: 3, range}, y: {distr: 3, range}},
        axes: [{...axis, label: "microseconds an ABRDF", labelFont: axis.font},
            {...axis, label: "mean \u0394E", labelFont: axis.font, size: 60}],
        legend: {show: false},
        series: [{label: "\u00B5s"}, ...lines.map(({method, input}) => ({
            label: method + ", " + input, stroke: colorOf(method), width: 2, spanGaps: true,
            dash: methods.indexOf(method) >= PALETTE.length ? [6, 4] : undefined,
            points: {show: true, size: 9, fill: colorOf(method)},
        }))],
    }, [times, ...lines.map((l) => l.values)], holder);
    const legend = document.createElement("ul");
    legend.className = "legend";
    methods.forEach((method) => {
        const entry = document.createElement("li");
        const swatch = document.createElement("i");
        swatch.style.background = colorOf(method);
        entry.append(swatch, method);
        legend.append(entry);
    });
    element("chart-section").querySelector(".legend")?.remove();
    holder.after(legend);
}

const themeButton = element("theme");
function labelTheme() {
    themeButton.textContent = isLight() ? "Dark page" : "Light page";
}
themeButton.hidden = false;
themeButton.addEventListener("click", () => {
    document.documentElement.dataset.theme = isLight() ? "dark" : "light";
    labelTheme();
    drawChart();
});
matchMedia("(prefers-color-scheme: light)").addEventListener("change", () => { labelTheme(); drawChart(); });
window.addEventListener("resize", () => chart?.setSize({width: Math.max(280, element("chart").clientWidth), height: 380}));
labelTheme();
drawChart();
