(() => {
  "use strict";
  const LIGHT = { text: "#1c2429", muted: "#55626a", grid: "#e4e8ea", zero: "#b4bdc2", lines: ["#0072b2", "#c24d00", "#007a5a", "#9a4a86"] };
  const DARK = { text: "#d5dcdf", muted: "#97a4ab", grid: "#263036", zero: "#4a575f", lines: ["#56b4e9", "#f0a35e", "#41c69c", "#d79cc6"] };
  const PRINT_WIDTH = 688; // an A4 page less its margins, in CSS pixels
  const PRINT_GAP = 20;
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const touch = matchMedia("(pointer: coarse)");
  const plots = [...document.querySelectorAll(".plot")].map((box) => ({ box, spec: JSON.parse(box.nextElementSibling.textContent) }));

  function traces(spec, theme) {
    const lines = spec.traces.map((trace) => ({
      type: "scatter", mode: "lines", name: trace.name, x: trace.x, y: trace.y, hoverinfo: "x+y+name",
      line: { color: theme.lines[trace.colour % theme.lines.length], width: trace.thin ? 0.8 : 1.2 },
    }));
    if (!spec.mark) return lines;
    const { x, y, text } = spec.mark;
    return [...lines, {
      type: "scatter", mode: "markers+text", name: "T₁", x: [x], y: [y], text: [text], textposition: "top right",
      marker: { color: theme.lines[1], size: 8 }, textfont: { color: theme.text }, cliponaxis: false, hoverinfo: "x+y",
    }];
  }

  function axis(title, theme, more) {
    return { title: { text: title, standoff: 8, font: { size: 12 } }, gridcolor: theme.grid, zerolinecolor: theme.zero, zerolinewidth: 1,
      linecolor: theme.zero, showline: true, ticks: "outside", ticklen: 4, tickcolor: theme.zero, automargin: true, nticks: 8, exponentformat: "power", ...more };
  }

  function layout(spec, theme, size) {
    const named = spec.traces.length > 1;
    return {
      ...size, autosize: !size.width, margin: { l: 62, r: 14, t: named ? 26 : 10, b: 44 }, showlegend: named,
      legend: { orientation: "h", x: 1, xanchor: "right", y: 1, yanchor: "bottom" },
      font: { family: "Inter, system-ui, 'Segoe UI', Roboto, 'Noto Sans', 'DejaVu Sans', sans-serif", size: 12, color: theme.muted },
      paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", dragmode: touch.matches ? false : "zoom", hovermode: "closest",
      xaxis: axis(spec.x, theme, spec.from_zero.includes("x") ? { rangemode: "tozero" } : {}),
      yaxis: axis(spec.y, theme, spec.from_zero.includes("y") ? { rangemode: "tozero" } : {}),
    };
  }

  function draw(theme, width) {
    for (const { box, spec } of plots) {
      const size = width ? { width: width(box), height: box.parentElement.classList.contains("tall") ? 400 : 200 } : {};
      Plotly.react(box, traces(spec, theme), layout(spec, theme, size), { displayModeBar: false, responsive: true });
    }
  }

  const onScreen = () => draw(dark.matches ? DARK : LIGHT);
  const half = (PRINT_WIDTH - PRINT_GAP) / 2;
  addEventListener("beforeprint", () => draw(LIGHT, (box) => (box.parentElement.classList.contains("wide") ? PRINT_WIDTH : half)));
  addEventListener("afterprint", onScreen);
  dark.addEventListener("change", onScreen);
  onScreen();
})();
