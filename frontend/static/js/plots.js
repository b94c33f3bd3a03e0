// @ts-check
// Draws every `.plot` from the JSON specification in the script element after it, on a page and in a stand-alone report.
(() => {
  "use strict";
  const LIGHT = { dark: false, text: "#1c2429", muted: "#55626a", grid: "#e4e8ea", zero: "#b4bdc2", shade: "#55626a", scale: ["#f3f5f6", "#f2c893", "#c24d00", "#6d1f00"], lines: ["#0072b2", "#c24d00", "#007a5a", "#9a4a86"] };
  const DARK = { dark: true, text: "#d5dcdf", muted: "#97a4ab", grid: "#263036", zero: "#4a575f", shade: "#97a4ab", scale: ["#1a2227", "#6b4a1d", "#e08a3c", "#ffe0bd"], lines: ["#56b4e9", "#f0a35e", "#41c69c", "#d79cc6"] };
  const PRINT_WIDTH = 688; // an A4 page less its margins, in CSS pixels
  const PRINT_GAP = 20;
  const NARROW = 480;
  const preferred = matchMedia("(prefers-color-scheme: dark)");
  const touch = matchMedia("(pointer: coarse)");
  const plots = [...document.querySelectorAll(".plot")].map((found) => {
    const box = /** @type {HTMLElement} */ (found);
    return { box, spec: /** @type {PlotSpec} */ (JSON.parse(box.nextElementSibling?.textContent ?? "")) };
  });

  /** @param {PlotSpec} spec @param {PlotTheme} theme @returns {object[]} */
  function traces(spec, theme) {
    if (spec.surface) return [surface(spec.surface, theme)];
    if (spec.rows) return spec.rows.map((row, i) => heat(row, i, spec, theme));
    const lines = spec.traces.map((trace) => (trace.bars ? bars(trace, theme) : line(trace, theme)));
    if (!spec.mark) return lines;
    const { x, y, text } = spec.mark;
    return [...lines, {
      type: "scatter", mode: "markers+text", name: "T₁", x: [x], y: [y], text: [text], textposition: "top right",
      marker: { color: theme.lines[1], size: 8 }, textfont: { color: theme.text }, cliponaxis: false, hoverinfo: "x+y",
    }];
  }

  /** @param {PlotTrace} trace @param {PlotTheme} theme */
  const colour = (trace, theme) => theme.lines[trace.colour % theme.lines.length];

  /** @param {PlotTrace} trace @param {PlotTheme} theme */
  const line = (trace, theme) => ({
    type: "scatter", mode: "lines", name: trace.name, x: trace.x, y: trace.y, hoverinfo: "x+y+name",
    line: { color: colour(trace, theme), width: trace.width ?? (trace.thin ? 0.8 : 1.2), dash: trace.dash ? "dash" : "solid" },
  });

  /** @param {PlotTrace} trace @param {PlotTheme} theme */
  const bars = (trace, theme) => ({
    type: "bar", name: trace.name, x: trace.x, y: trace.y, hoverinfo: "x+y+name", marker: { color: colour(trace, theme) },
  });

  /** One row of a map. The noise ends at one third of the colour scale. @param {PlotRow} row @param {number} i @param {PlotSpec} spec @param {PlotTheme} theme */
  const heat = (row, i, spec, theme) => ({
    type: "heatmap", x: row.x, y: [i], z: [row.z], customdata: [row.said], zmin: spec.scale.from, zmax: spec.scale.to, xgap: 1, ygap: 6,
    colorscale: theme.scale.map((one, k) => [k / (theme.scale.length - 1), one]), showscale: i === 0,
    colorbar: { title: { text: spec.scale.title, side: "right", font: { size: 11 } }, tickvals: spec.scale.at, ticktext: spec.scale.said, thickness: 10, outlinewidth: 0 },
    hovertemplate: `%{x:.1f} s: %{customdata:.3g}<extra>${row.name}</extra>`,
  });

  /** Means in cells: negative and positive values have the two ends of the colour scale. @param {PlotSurface} map @param {PlotTheme} theme */
  const surface = (map, theme) => ({
    type: "heatmap", x: map.x, y: map.y, z: map.z, customdata: map.said, zmin: -map.limit, zmax: map.limit, xgap: 1, ygap: 1, hoverongaps: false,
    colorscale: [[0, theme.lines[0]], [0.5, theme.scale[0]], [1, theme.lines[1]]],
    colorbar: { title: { text: map.title, side: "right", font: { size: 11 } }, thickness: 10, outlinewidth: 0 },
    hovertemplate: "%{customdata}<extra></extra>",
  });

  /** @param {string} title @param {PlotTheme} theme @param {object} more */
  function axis(title, theme, more) {
    return { title: { text: title, standoff: 8, font: { size: 12 } }, gridcolor: theme.grid, zerolinecolor: theme.zero, zerolinewidth: 1,
      linecolor: theme.zero, showline: true, ticks: "outside", ticklen: 4, tickcolor: theme.zero, automargin: true, nticks: 8, exponentformat: "power", ...more };
  }

  /** @param {PlotSpec} spec @param {string} name */
  const kind = (spec, name) => ({ ...((spec.log ?? "").includes(name) ? { type: "log", nticks: 5, minor: { showgrid: false } } : {}), ...(spec.from_zero.includes(name) ? { rangemode: "tozero" } : {}) });

  /** @param {PlotSpan[]} spans @param {PlotTheme} theme */
  const shaded = (spans, theme) => spans.map(({ from, to }) => ({
    type: "rect", xref: "x", yref: "paper", x0: from, x1: to, y0: 0, y1: 1, line: { width: 0 }, fillcolor: theme.shade, opacity: 0.14, layer: "below",
  }));

  /** @param {PlotSpan[]} spans @param {PlotTheme} theme */
  const notes = (spans, theme) => spans.map(({ from, to, text }) => ({
    text, x: (from + to) / 2, xref: "x", y: 1, yref: "paper", yanchor: "top", showarrow: false, font: { size: 10, color: theme.muted },
  }));

  /** A long name of a row on two lines, so that it leaves room for the map. @param {string} name */
  const twoLines = (name) => name.replace(/ (of|in) /, "<br>$1 ");

  /** @param {PlotSpec} spec @param {PlotTheme} theme @param {PlotSize} size */
  function layout(spec, theme, size) {
    const named = !spec.rows && !spec.surface && spec.traces.length > 1;
    return {
      ...size, autosize: !size.width, margin: { l: 62, r: 14, t: named ? 26 : 10, b: 44 }, showlegend: named,
      legend: { orientation: "h", x: 1, xanchor: "right", y: 1, yanchor: "bottom" },
      font: { family: "Inter, system-ui, 'Segoe UI', Roboto, 'Noto Sans', 'DejaVu Sans', sans-serif", size: 12, color: theme.muted },
      paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", dragmode: touch.matches ? false : "zoom", hovermode: "closest",
      barmode: "group", bargap: 0.35, shapes: shaded(spec.spans ?? [], theme), annotations: notes(spec.spans ?? [], theme),
      xaxis: axis(spec.x, theme, kind(spec, "x")),
      yaxis: spec.rows ? axis("", theme, { tickvals: spec.rows.map((_, i) => i), ticktext: spec.rows.map((row) => twoLines(row.name)), range: [spec.rows.length - 0.5, -0.5], showgrid: false, zeroline: false }) : axis(spec.y, theme, kind(spec, "y")),
    };
  }

  /** @param {PlotTheme} theme @param {(box: HTMLElement) => number} [width] the width in print; on a screen, a plot fills its box */
  function draw(theme, width) {
    for (const { box, spec } of plots) {
      if (spec.height) box.style.height = `${spec.height}px`;
      const shown = !width && spec.spans && box.clientWidth < NARROW ? { ...spec, spans: spec.spans.map((span) => ({ ...span, text: "" })) } : spec;
      const size = width ? { width: width(box), height: spec.height ?? (box.parentElement?.classList.contains("tall") ? 400 : 200) } : {};
      Plotly.react(box, traces(shown, theme), layout(shown, theme, size), { displayModeBar: false, responsive: true });
    }
  }

  const chosen = () => document.documentElement.dataset.theme ?? (preferred.matches ? "dark" : "light");
  const onScreen = () => draw(chosen() === "dark" ? DARK : LIGHT);
  const half = (PRINT_WIDTH - PRINT_GAP) / 2;
  addEventListener("beforeprint", () => draw(LIGHT, (box) => (box.parentElement?.classList.contains("wide") ? PRINT_WIDTH : half)));
  addEventListener("afterprint", onScreen);
  preferred.addEventListener("change", onScreen);
  document.addEventListener("themechange", onScreen);
  onScreen();
})();
