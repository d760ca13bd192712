// Latest: at most one request runs and at most one waits, the newest. While a slider moves, every answer is
// shown that the server can give in time, and none is given up half way.
import { report } from "../state/notices";
import { Failure } from "./http";

type Work = (signal: AbortSignal) => Promise<void>;

export class Latest {
    private controller: AbortController | null = null;
    private waiting: Work | null = null;

    /** Runs the work when the work before it has ended, unless newer work comes meanwhile. */
    run(work: Work): void {
        if (this.controller) {
            this.waiting = work;
            return;
        }
        void this.start(work);
    }

    /** Gives up what runs and what waits. */
    cancel(): void {
        this.waiting = null;
        this.controller?.abort();
        this.controller = null;
    }

    private async start(work: Work): Promise<void> {
        const controller = new AbortController();
        this.controller = controller;
        try {
            await work(controller.signal);
        } catch (error) {
            // A 404 comes of a job that the server no longer keeps: a newer one is on its way.
            if (!(error instanceof Failure && (error.outdated || error.status === 404))) report(error);
        }
        if (this.controller !== controller) return;
        this.controller = null;
        const next = this.waiting;
        this.waiting = null;
        if (next) void this.start(next);
    }
}
