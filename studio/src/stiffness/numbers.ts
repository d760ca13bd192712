// Numbers for people.

export const figure = (value: number, digits = 3): string => {
    const rounded = Number(value.toPrecision(digits));
    return Math.abs(rounded) >= 1e5 || (rounded !== 0 && Math.abs(rounded) < 1e-5)
        ? rounded.toExponential(digits - 1)
        : String(rounded);
};

export const percent = (share: number, digits = 3): string => `${figure(100 * share, digits)} %`;

/** Standard deviation of samples about their mean; 0 for one. */
export function deviation(values: number[]): number {
    if (values.length < 2) return 0;
    const mean = values.reduce((sum, one) => sum + one, 0) / values.length;
    return Math.sqrt(values.reduce((sum, one) => sum + (one - mean) ** 2, 0) / (values.length - 1));
}
