// @ts-check

/** A path through all points in order, without points on the same pixel as the point before; a missing value is a gap. For uPlot's mode 2. @param {any} u @param {number} series */
export function loopPath(u, series) {
  const [xs, ys] = u.data[series];
  const { left, top, width, height } = u.bbox;
  const [x, y] = [u.scales.x, u.scales.y];
  const [px, py] = [width / (x.max - x.min), height / (y.max - y.min)];
  const stroke = new Path2D();
  through(stroke, xs, ys, 0, xs.length, (at) => left + (at - x.min) * px, (at) => top + height - (at - y.min) * py);
  return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 1 };
}

/**
 * Draw points [first, end) into a path or a context. A missing value, which is null or not finite, is a gap.
 * @param {Path2D | CanvasRenderingContext2D} path @param {ArrayLike<number | null>} xs @param {ArrayLike<number | null>} ys @param {number} first @param {number} end @param {(x: number) => number} toX @param {(y: number) => number} toY
 */
export function through(path, xs, ys, first, end, toX, toY) {
  let [lastX, lastY, gap] = [NaN, NaN, true];
  for (let i = first; i < end; i++) {
    const [x, y] = [xs[i], ys[i]];
    if (x === null || y === null || !Number.isFinite(x) || !Number.isFinite(y)) {
      gap = true;
      continue;
    }
    const [atX, atY] = [Math.round(toX(x)), Math.round(toY(y))];
    if (!gap && atX === lastX && atY === lastY) continue;
    if (gap) path.moveTo(atX, atY);
    else path.lineTo(atX, atY);
    [lastX, lastY, gap] = [atX, atY, false];
  }
}
