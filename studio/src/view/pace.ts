// Pace: counts frames, and finds the resolution at which orbiting stays smooth.

/** Frames that are further apart belong to different movements, ms. */
const pause = 500;
/** Shares of the screen's pixels along an edge. Few of them: another size of the canvas costs time itself. */
const scales = [1, 0.7, 0.5, 0.36, 0.27];
const slow = 33;
const fast = 14;
/** Frames after a change of the resolution until the next one. */
const rest = 5;

export class Pace {
    private times: number[] = [];
    private level = 2;
    private since = 0;

    /** Share of the screen's pixels along an edge that are drawn while the view moves. */
    get scale(): number {
        return scales[this.level]!;
    }

    /** A frame of a movement is drawn at this time. */
    frame(now: number): void {
        const last = this.times.at(-1);
        if (last !== undefined && now - last > pause) this.times = [];
        this.times.push(now);
        if (this.times.length > 120) this.times.shift();
        if (this.times.length < 5 || ++this.since < rest) return;
        const recent = this.times.slice(-5);
        const average = (recent.at(-1)! - recent[0]!) / 4;
        const next = this.level + (average > 2 * slow ? 2 : average > slow ? 1 : average < fast ? -1 : 0);
        const level = Math.max(0, Math.min(scales.length - 1, next));
        if (level === this.level) return;
        this.level = level;
        this.since = 0;
    }

    /** Frames a second of the movement that goes on or was the last. */
    get fps(): number {
        const recent = this.times.filter((time) => this.times.at(-1)! - time <= 2000);
        if (recent.length < 2) return 0;
        return (1000 * (recent.length - 1)) / (recent.at(-1)! - recent[0]!);
    }
}
