// Latest: at most one request runs and at most one waits, the newest. While a slider moves, every answer is
// shown that the server can give in time; what takes longer may be given up for what is newer.
import { report } from "../state/notices";
import { Failure } from "./http";

type Work = (signal: AbortSignal) => Promise<void>;

export class Latest {
    private controller: AbortController | null = null;
    private waiting: Work | null = null;
    private begun = 0;
    private timer = 0;

    /** Work that has run for longer than `patience` (ms) is given up once newer work comes. */
    constructor(private readonly patience = Infinity) {}

    /** Runs the work when the work before it has ended, unless newer work comes meanwhile. */
    run(work: Work): void {
        if (!this.controller) {
            void this.start(work);
            return;
        }
        this.waiting = work;
        if (this.timer || this.patience === Infinity) return;
        const running = this.controller;
        this.timer = window.setTimeout(
            () => {
                this.timer = 0;
                if (this.controller === running) running.abort(); // its end starts what waits
            },
            Math.max(0, this.begun + this.patience - performance.now()),
        );
    }

    /** Gives up what runs and what waits. */
    cancel(): void {
        this.waiting = null;
        clearTimeout(this.timer);
        this.timer = 0;
        this.controller?.abort();
        this.controller = null;
    }

    private async start(work: Work): Promise<void> {
        const controller = new AbortController();
        this.controller = controller;
        this.begun = performance.now();
        try {
            await work(controller.signal);
        } catch (error) {
            // A 404 comes of a job that the server no longer keeps: a newer one is on its way.
            if (!(error instanceof Failure && (error.outdated || error.status === 404))) report(error);
        }
        if (this.controller !== controller) return;
        this.controller = null;
        clearTimeout(this.timer);
        this.timer = 0;
        const next = this.waiting;
        this.waiting = null;
        if (next) void this.start(next);
    }
}
