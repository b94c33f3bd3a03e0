// Types of what scripts share with the page: Plotly, and the plots that the service describes (app/reports).

interface PlotTrace {
  name: string;
  x: unknown;
  y: unknown;
  colour: number;
  width?: number;
  thin?: boolean;
  dash?: boolean;
  bars?: boolean;
}

/** One row of a heat map: values over time, and the values as its hover text says them. */
interface PlotRow {
  name: string;
  x: unknown;
  z: unknown;
  said: unknown;
}

/** A heat map of cells: `z` holds a row for each `y`; `said` is the hover text of each cell. */
interface PlotSurface {
  x: number[];
  y: number[];
  z: (number | null)[][];
  said: string[][];
  limit: number;
  title: string;
}

interface PlotSpan {
  from: number;
  to: number;
  text: string;
}

/** A plot: lines and bars in `traces`, or a heat map in `rows` or in `surface`. `from_zero` and `log` name axes, such as "xy". */
interface PlotSpec {
  traces: PlotTrace[];
  rows?: PlotRow[];
  surface?: PlotSurface;
  scale: { from: number; to: number; title: string; at: number[]; said: string[] };
  mark?: { x: number; y: number; text: string };
  spans?: PlotSpan[];
  x: string;
  y: string;
  from_zero: string;
  log?: string;
  height?: number;
}

/** CSS pixels of a print; empty on a screen, where Plotly measures the box. */
interface PlotSize {
  width?: number;
  height?: number;
}

interface PlotTheme {
  dark: boolean;
  text: string;
  muted: string;
  grid: string;
  zero: string;
  shade: string;
  scale: string[];
  lines: string[];
}

declare const Plotly: {
  react(box: Element, data: object[], layout: object, config: object): Promise<unknown>;
};
