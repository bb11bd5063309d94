// The shared state of the page: current time, zoom and selection.

export type Listener = () => void;

export class Player {
  /** Position in the stored frames; between two of them while playing. */
  frame = 0;
  playing = false;
  speed = 1;
  loop = true;
  /** First and last frame in view of curves and timeline. */
  from = 0;
  to: number;
  /** Tracks whose curves and trails are shown. */
  chosen: number[] = [];
  private readonly moved: Listener[] = [];
  private readonly zoomed: Listener[] = [];
  private readonly changed: Listener[] = [];
  private last = 0;

  constructor(readonly frames: number, readonly rate: number) {
    this.to = Math.max(1, frames - 1);
  }

  onMove(listener: Listener): void { this.moved.push(listener); }
  onZoom(listener: Listener): void { this.zoomed.push(listener); }
  onChoice(listener: Listener): void { this.changed.push(listener); }
  private tell(listeners: Listener[]): void { for (const listener of listeners) listener(); }

  /** The visible frame. */
  get shown(): number { return Math.max(0, Math.min(this.frames - 1, Math.floor(this.frame + 1e-6))); }

  seek(frame: number): void {
    this.frame = Math.max(0, Math.min(Math.max(0, this.frames - 1), frame));
    this.tell(this.moved);
  }
  /** Goes to a frame, which may be out of view. */
  jump(frame: number): void {
    this.seek(Math.round(frame));
    if (this.frame >= this.from && this.frame <= this.to) return;
    const width = this.to - this.from;
    this.zoom(this.frame - width / 2, this.frame + width / 2);
  }
  step(by: number): void {
    this.pause();
    this.jump(this.shown + by);
  }

  zoom(from: number, to: number): void {
    const most = Math.max(1, this.frames - 1);
    const width = Math.max(Math.min(4, most), Math.min(most, to - from));
    this.from = Math.max(0, Math.min(most - width, from));
    this.to = this.from + width;
    this.tell(this.zoomed);
  }
  zoomBy(factor: number, about = this.frame): void {
    const at = about >= this.from && about <= this.to ? about : (this.from + this.to) / 2;
    this.zoom(at - (at - this.from) * factor, at + (this.to - at) * factor);
  }

  choose(tracks: number[]): void {
    this.chosen = tracks;
    this.tell(this.changed);
  }
  toggleTrack(track: number, most = 4): void {
    const without = this.chosen.filter((one) => one !== track);
    this.choose(without.length < this.chosen.length ? without : [...this.chosen, track].slice(-most));
  }
  refresh(): void {
    this.tell(this.changed);
    this.tell(this.moved);
  }

  play(): void {
    if (this.playing || this.frames < 2) return;
    if (this.shown >= this.frames - 1) this.frame = 0;
    this.playing = true;
    this.last = performance.now();
    requestAnimationFrame(this.tick);
    this.tell(this.moved);
  }
  pause(): void {
    this.playing = false;
    this.tell(this.moved);
  }
  private readonly tick = (now: number): void => {
    if (!this.playing) return;
    let frame = this.frame + ((now - this.last) / 1000) * this.rate * this.speed;
    this.last = now;
    if (frame > this.frames - 1) {
      if (!this.loop) {
        this.seek(this.frames - 1);
        return this.pause();
      }
      frame %= this.frames;
    }
    this.seek(frame);
    requestAnimationFrame(this.tick);
  };
}
