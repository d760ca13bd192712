// Pace: counts frames, and finds the resolution at which orbiting stays smooth.

/** Frames that are further apart belong to different movements, ms. */
const pause = 500;
const slow = 60;
const fast = 28;

export class Pace {
    private times: number[] = [];
    /** Share of the screen's pixels along an edge that are drawn while the view moves. */
    scale = 1;

    constructor(private readonly least: number) {}

    /** A frame is drawn at this time. `moving`: one of a movement, whose resolution may change. */
    frame(now: number, moving: boolean): void {
        const last = this.times.at(-1);
        if (last !== undefined && now - last > pause) this.times = [];
        this.times.push(now);
        if (this.times.length > 60) this.times.shift();
        if (!moving || this.times.length < 4 || this.times.length % 3) return;
        const recent = this.times.slice(-4);
        const average = (recent.at(-1)! - recent[0]!) / 3;
        if (average > slow) this.scale = Math.max(this.least, this.scale * Math.max(0.6, Math.sqrt(45 / average)));
        else if (average < fast) this.scale = Math.min(1, this.scale * 1.12);
    }

    /** Frames a second of the movement that goes on or was the last. */
    get fps(): number {
        const recent = this.times.filter((time) => this.times.at(-1)! - time <= 2000);
        if (recent.length < 2) return 0;
        return 1000 * (recent.length - 1) / (recent.at(-1)! - recent[0]!);
    }
}
