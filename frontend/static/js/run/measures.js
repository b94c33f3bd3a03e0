// @ts-check

/** @typedef {{key: string, label: string, unit: string, decimals: number, long: string}} Measure */

/** @param {string} key @param {string} label @param {string} unit @param {number} decimals @param {string} long @returns {Measure} */
const measure = (key, label, unit, decimals, long) => ({ key, label, unit, decimals, long });

/** Measures of a station, as in Table IV of the paper. */
export const PAPERS = [
  measure("mte_mm", "MTE", "mm", 2, "maximum tracking error"),
  measure("rms_percent", "RMS", "%", 2, "root mean square of the tracking error, relative to the command's"),
  measure("mti_mm2", "MTI", "mm²", 1, "extreme tracking indicator; positive: the actuator lagged"),
  measure("mee_kNm", "MEE", "kN·m", 2, "extreme energy error of one damper; negative: energy fed in"),
  measure("peak_stroke_mm", "Peak stroke", "mm", 1, "largest measured displacement"),
  measure("peak_force_kN", "Peak force", "kN", 1, "largest measured force of one damper"),
];

/** Further measures of a station. */
export const BEYOND = [
  measure("fei_delay_ms", "FEI delay", "ms", 2, "generalised delay by the frequency evaluation index; positive: late"),
  measure("fei_amplitude", "FEI amplitude", "", 4, "generalised amplitude by the frequency evaluation index; below 1: undershoot"),
  measure("delay_ms", "Delay", "ms", 2, "lag of the largest cross-correlation; positive: late"),
  measure("nrms_percent", "NRMSE", "%", 2, "root mean square tracking error over the command's range"),
  measure("peak_error_percent", "Peak error", "%", 2, "largest tracking error over the largest command"),
  measure("energy_error_percent", "HSEE", "%", 2, "energy error of the station's dampers over the input energy; negative: energy fed in"),
];

/** Measure of the whole run. */
export const INPUT_ENERGY = measure("input_energy_kNm", "Input energy", "kN·m", 1, "largest energy put in by the ground and by forces on floors");

/** What says nothing in a kind of test: without a structure there is no energy to be fed into it. @type {Record<string, string[]>} */
const SILENT = { specimen: ["mti_mm2", "mee_kNm", "energy_error_percent"], actuator: ["mee_kNm", "energy_error_percent"] };

/** Those that say something in a kind of test. @param {Measure[]} measures @param {string} test */
export const telling = (measures, test) => measures.filter(({ key }) => !SILENT[test]?.includes(key));
