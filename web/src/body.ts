// The body in space: joints, bones, markers, the floor, contacts and trails.

import * as three from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { distanceApart, middleOf } from './apart';
import { colour, describeCanvas, element } from './dom';
import type { Player } from './player';
import type { Take, Which } from './take';

export type View = 'orbit' | 'front' | 'side' | 'top';
export interface BodyOptions {
  before: boolean;
  after: boolean;
  apart: boolean;
  follow: boolean;
}

const axes: Record<string, three.Vector3> = {
  x: new three.Vector3(1, 0, 0),
  y: new three.Vector3(0, 1, 0),
  z: new three.Vector3(0, 0, 1),
};
const trail_s = 0.5;

/** Spheres for the points of one take, and bones between them. */
class Figure {
  readonly group = new three.Group();
  readonly pose: Float32Array;
  private readonly balls: three.InstancedMesh;
  private readonly bones: three.InstancedMesh | null = null;
  private readonly links: [number, number][] = [];
  private readonly material: three.MeshLambertMaterial;
  private readonly matrix = new three.Matrix4();

  constructor(private readonly take: Take, readonly which: Which, private readonly size: number, private readonly name: string) {
    this.pose = new Float32Array(3 * take.points);
    const faint = which === 'before' && take.data.two;
    this.material = new three.MeshLambertMaterial({ transparent: faint, opacity: faint ? 0.55 : 1 });
    const radius = size * (take.isJoints ? 0.012 : 0.011);
    this.balls = new three.InstancedMesh(new three.SphereGeometry(radius, 12, 8), this.material, Math.max(1, take.points));
    this.balls.frustumCulled = false;
    this.group.add(this.balls);
    const skeleton = take.data.skeleton;
    if (skeleton) {
      skeleton.parents.forEach((parent, joint) => { if (parent >= 0) this.links.push([parent, joint]); });
      skeleton.ends.forEach((end, i) => this.links.push([end.parent, skeleton.parents.length + i]));
    } else {
      this.links.push(...(take.data.links ?? []));
    }
    if (this.links.length > 0) {
      // The bone of a joint points to its child; a line between markers has no direction.
      const shape = skeleton ? new three.CylinderGeometry(size * 0.004, size * 0.01, 1, 8) : new three.CylinderGeometry(size * 0.003, size * 0.003, 1, 6);
      shape.translate(0, 0.5, 0);
      this.bones = new three.InstancedMesh(shape, this.material, this.links.length);
      this.bones.frustumCulled = false;
      this.group.add(this.bones);
    }
  }

  paint(): void { this.material.color.set(colour(this.name)); }

  at(point: number): three.Vector3 | null {
    const x = this.pose[3 * point];
    return Number.isNaN(x) ? null : new three.Vector3(x, this.pose[3 * point + 1], this.pose[3 * point + 2]);
  }

  show(frame: number, chosen: number[]): void {
    this.take.pose(frame, this.which, this.pose);
    const none = new three.Matrix4().makeScale(0, 0, 0);
    for (let p = 0; p < this.take.points; ++p) {
      const place = this.take.isShown(p) ? this.at(p) : null;
      const large = chosen.includes(p) ? 1.9 : 1;
      this.balls.setMatrixAt(p, place === null ? none : this.matrix.makeScale(large, large, large).setPosition(place));
    }
    this.balls.instanceMatrix.needsUpdate = true;
    if (this.bones === null) return;
    this.links.forEach(([from, to], i) => this.bones?.setMatrixAt(i, this.bone(from, to) ?? none));
    this.bones.instanceMatrix.needsUpdate = true;
  }

  private bone(from: number, to: number): three.Matrix4 | null {
    const start = this.at(from);
    const end = this.at(to);
    if (start === null || end === null) return null;
    const way = end.clone().sub(start);
    const length = way.length();
    if (length < 1e-9 * this.size) return null;
    const turn = new three.Quaternion().setFromUnitVectors(axes.y, way.divideScalar(length));
    return this.matrix.compose(start, turn, new three.Vector3(1, length, 1)).clone();
  }

  /** The middle of the body. */
  centre(): three.Vector3 | null {
    const middle = middleOf(this.take, this.pose);
    return middle === null ? null : new three.Vector3(...middle);
  }
}

/** Creating a renderer is slow and browsers allow few, so all bodies of the page share this one. */
let renderer: three.WebGLRenderer | null = null;

/** Returns the renderer; null if the browser has no WebGL. */
export function makeRenderer(): three.WebGLRenderer | null {
  try {
    return renderer ??= new three.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
  } catch {
    return null;
  }
}

/** Compiles the shaders for bodies in advance; the materials are those of `Body`. */
export async function warmRenderer(): Promise<void> {
  const made = makeRenderer();
  if (made === null) return;
  const scene = new three.Scene();
  const ball = new three.SphereGeometry(1, 3, 2);
  const materials = [new three.MeshLambertMaterial(), new three.MeshLambertMaterial({ transparent: true }), new three.MeshBasicMaterial({ transparent: true })];
  scene.add(new three.HemisphereLight(), new three.DirectionalLight(), new three.GridHelper(), new three.Line(ball, new three.LineBasicMaterial()),
    ...materials.map((material) => new three.InstancedMesh(ball, material, 1)));
  await made.compileAsync(scene, new three.PerspectiveCamera());
}

export class Body {
  readonly options: BodyOptions = { before: true, after: true, apart: false, follow: true };
  readonly figures: Figure[] = [];
  private readonly scene = new three.Scene();
  private readonly camera: three.PerspectiveCamera;
  private readonly controls: OrbitControls;
  private readonly renderer: three.WebGLRenderer;
  private readonly up: three.Vector3;
  private readonly across: three.Vector3;
  private readonly ahead: three.Vector3;
  private readonly size: number;
  private readonly floor: three.Group = new three.Group();
  private readonly soles: three.InstancedMesh;
  private readonly trails = new three.Group();
  private readonly gizmo: SVGSVGElement;
  private centre = new three.Vector3();
  private readonly unseen = element('p', { class: 'unseen', hidden: true }, 'Every marker is missing in this frame.');
  /** The name of the point at the mouse. */
  private readonly tip = element('p', { class: 'tip', hidden: true });
  private waiting = false;
  private ended = false;
  /** The distance between the two bodies side by side; computed when needed. */
  private distance: number | null = null;

  constructor(private readonly holder: HTMLElement, private readonly take: Take, private readonly player: Player, renderer: three.WebGLRenderer) {
    const { stage } = take.data;
    this.size = stage.height;
    this.up = axes[stage.up].clone().multiplyScalar(stage.sign);
    // Seen from the front, the first of the other axes points to the right.
    this.across = axes[stage.up === 'x' ? 'y' : 'x'].clone();
    this.ahead = this.across.clone().cross(this.up);
    this.renderer = renderer;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.camera = new three.PerspectiveCamera(35, 1, this.size / 50, this.size * 200);
    this.camera.up.copy(this.up);
    holder.append(this.renderer.domElement);
    this.gizmo = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.gizmo.setAttribute('class', 'axes');
    this.gizmo.setAttribute('viewBox', '-30 -30 60 60');
    this.gizmo.setAttribute('aria-hidden', 'true');
    holder.append(this.gizmo, this.unseen, this.tip);
    const shown = `${take.data.names.length} ${take.isJoints ? 'joints' : 'markers'}`;
    describeCanvas(this.renderer.domElement, `The body in 3D, ${shown}${take.data.two ? `: ${take.data.labels.join(' and ')}` : ''}`);
    holder.addEventListener('pointermove', (event) => this.point(event));
    holder.addEventListener('pointerleave', () => { this.tip.hidden = true; });
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => {
      this.place();
      this.draw();
    });

    this.scene.add(new three.HemisphereLight(0xffffff, 0x888888, 2.6));
    const sun = new three.DirectionalLight(0xffffff, 1.2);
    sun.position.copy(this.up).multiplyScalar(3).add(this.ahead).add(this.across);
    this.scene.add(sun, this.floor, this.trails);
    this.soles = new three.InstancedMesh(new three.CylinderGeometry(this.size * 0.035, this.size * 0.035, this.size * 0.002, 20),
      new three.MeshBasicMaterial({ transparent: true, opacity: 0.8 }), 64);
    this.soles.frustumCulled = false;
    this.scene.add(this.soles);
    for (const which of take.takes) this.figures.push(new Figure(take, which, this.size, take.data.two ? which : 'after'));
    for (const figure of this.figures) this.scene.add(figure.group);

    this.paint();
    this.refresh();
    this.look('orbit');
    player.onMove(() => this.refresh());
    player.onChoice(() => this.refresh());
    new ResizeObserver(() => this.resize()).observe(holder);
    this.resize();
  }

  /** The name of a joint, a marker or an end site. */
  private nameOf(point: number): string {
    const { names, skeleton } = this.take.data;
    if (point < names.length) return this.take.nameOf(point);
    const parent = skeleton?.ends[point - names.length]?.parent ?? 0;
    return `end of ${names[parent]}`;
  }

  /** Shows the name of the point nearest to the mouse. */
  private point(event: PointerEvent): void {
    const reach = 14;
    const { left, top, width, height } = this.holder.getBoundingClientRect();
    const [x, y] = [event.clientX - left, event.clientY - top];
    this.camera.updateMatrixWorld();
    let nearest = reach;
    let named = '';
    for (const figure of this.figures) {
      if (!this.isOn(figure)) continue;
      for (let p = 0; p < this.take.points; ++p) {
        const place = this.take.isShown(p) ? figure.at(p) : null;
        if (place === null) continue;
        place.add(figure.group.position).project(this.camera);
        const distance = Math.hypot(((place.x + 1) / 2) * width - x, ((1 - place.y) / 2) * height - y);
        if (place.z > 1 || distance >= nearest) continue;
        nearest = distance;
        named = this.nameOf(p);
      }
    }
    this.tip.hidden = named === '';
    if (named === '') return;
    this.tip.textContent = named;
    // Places the name beside the mouse, on the side with more space.
    this.tip.style.transform = `translate(${x}px, ${y}px) translate(${x > width / 2 ? 'calc(-100% - 12px)' : '12px'}, ${y > height / 2 ? '-100%' : '0'})`;
  }

  private get main(): Figure { return this.figures[this.figures.length - 1]; }

  private isOn(figure: Figure): boolean {
    return !this.take.data.two || this.options[figure.which];
  }

  /** The distance between the two bodies; 0 if they are in the same place. */
  private get apart(): number {
    if (!this.options.apart || !this.take.data.two) return 0;
    return this.distance ??= distanceApart(this.take);
  }

  /** Puts the two bodies side by side in the camera's view, on either side of a plane through it. */
  private place(): void {
    const up = new three.Vector3(0, 1, 0).applyQuaternion(this.camera.quaternion);
    const right = this.centre.clone().sub(this.camera.position).cross(up).normalize();
    for (const figure of this.figures) figure.group.position.copy(right).multiplyScalar((figure.which === 'before' ? -0.5 : 0.5) * this.apart);
    this.soles.position.copy(this.main.group.position);
    for (const line of this.trails.children) line.position.copy((line.userData as { figure: Figure }).figure.group.position);
  }

  /** Shows the bodies side by side or in one place; the camera moves back as far as both need. */
  setApart(on: boolean): void {
    const before = this.ball().radius;
    this.options.apart = on;
    const way = this.camera.position.clone().sub(this.controls.target).multiplyScalar(this.ball().radius / before);
    this.camera.position.copy(this.controls.target).add(way);
    this.controls.update();
    this.refresh();
  }

  /** The box that the body moves in during the whole take. */
  private extent(): three.Box3 {
    const box = new three.Box3();
    const frames = Math.min(60, this.take.told);
    const pose = new Float32Array(3 * this.take.points);
    for (let i = 0; i < frames; ++i) {
      this.take.pose(Math.floor((i * this.take.told) / frames), this.take.last, pose);
      for (let p = 0; p < this.take.points; ++p) {
        if (this.take.isShown(p) && !Number.isNaN(pose[3 * p])) box.expandByPoint(new three.Vector3(pose[3 * p], pose[3 * p + 1], pose[3 * p + 2]));
      }
    }
    return box;
  }

  /** A sphere around the body as it is now; ignores a marker far away from all others. */
  private ball(): three.Sphere {
    const box = new three.Box3();
    const middle = this.main.centre() ?? new three.Vector3();
    for (let p = 0; p < this.take.points; ++p) {
      const place = this.take.isShown(p) ? this.main.at(p) : null;
      if (place !== null && place.distanceTo(middle) < 1.5 * this.size) box.expandByPoint(place);
    }
    if (box.isEmpty()) return new three.Sphere(middle, 0.6 * this.size + this.apart / 2);
    const ball = box.getBoundingSphere(new three.Sphere());
    ball.radius = Math.max(ball.radius, 0.3 * this.size) + this.apart / 2;
    return ball;
  }

  /** Sets the colours, also after a change of theme. */
  paint(): void {
    for (const figure of this.figures) figure.paint();
    (this.soles.material as three.MeshBasicMaterial).color.set(colour('held'));
    this.floor.clear();
    const box = this.extent();
    const middle = box.isEmpty() ? new three.Vector3() : box.getCenter(new three.Vector3());
    const span = box.isEmpty() ? this.size : box.getSize(new three.Vector3()).length();
    const cell = this.size / 3.4;
    const cells = Math.min(120, 2 * Math.ceil((span * 0.6 + 1.5 * this.size) / cell));
    const grid = new three.GridHelper(cells * cell, cells, colour('grid-strong'), colour('grid'));
    grid.quaternion.setFromUnitVectors(axes.y, this.up);
    middle.addScaledVector(this.up, this.take.data.stage.floor - middle.dot(this.up));
    grid.position.copy(middle);
    this.floor.add(grid);
    this.trace();
    this.draw();
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.holder;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  look(view: View): void {
    const { center: target, radius } = this.ball();
    const narrow = Math.min(1, this.camera.aspect);
    const far = (1.1 * radius) / (Math.sin((this.camera.fov * Math.PI) / 360) * narrow);
    const from = {
      orbit: this.ahead.clone().multiplyScalar(0.8).addScaledVector(this.across, 0.6).addScaledVector(this.up, 0.22),
      front: this.ahead.clone(),
      side: this.across.clone(),
      // Slightly tilted, because up is undefined for a camera that looks straight down.
      top: this.up.clone().addScaledVector(this.ahead, 0.001),
    }[view].normalize();
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(from, far);
    this.centre = this.main.centre() ?? this.centre;
    this.controls.update();
    this.place();
    this.draw();
  }

  /** Moves the camera to the body's current place. */
  recentre(): void {
    const way = this.ball().center.sub(this.controls.target);
    this.camera.position.add(way);
    this.controls.target.add(way);
    this.draw();
  }

  private follow(): void {
    const now = this.main.centre();
    if (now === null) return;
    const way = now.clone().sub(this.centre);
    way.addScaledVector(this.up, -way.dot(this.up));
    this.centre = now;
    if (!this.options.follow) return;
    this.camera.position.add(way);
    this.controls.target.add(way);
  }

  refresh(): void {
    for (const figure of this.figures) {
      figure.group.visible = this.isOn(figure);
      if (this.take.told > 0) figure.show(this.player.shown, this.player.chosen);
    }
    this.unseen.hidden = this.main.centre() !== null;
    this.stand();
    this.follow();
    this.trace();
    this.place();
    this.draw();
  }

  /** Draws a disc below each foot in ground contact. */
  private stand(): void {
    const frame = this.player.shown * this.take.data.step;
    const turn = new three.Quaternion().setFromUnitVectors(axes.y, this.up);
    const { floor, contacts } = this.take.data.stage;
    let count = 0;
    for (const contact of contacts) {
      if (frame < contact.first || frame > contact.last) continue;
      for (const point of contact.points.slice(0, 3)) {
        const place = this.main.at(point);
        if (place === null || count >= 64) continue;
        place.addScaledVector(this.up, floor - place.dot(this.up));
        this.soles.setMatrixAt(count++, new three.Matrix4().compose(place, turn, new three.Vector3(1, 1, 1)));
      }
    }
    this.soles.count = count;
    this.soles.instanceMatrix.needsUpdate = true;
  }

  /** Draws paths of the chosen tracks, half a second to either side. */
  private trace(): void {
    for (const line of this.trails.children) (line as three.Line).geometry.dispose();
    this.trails.clear();
    if (this.take.told === 0 || this.player.chosen.length === 0) return;
    const width = Math.max(2, Math.round(trail_s * this.take.rate));
    const first = Math.max(0, this.player.shown - width);
    const last = Math.min(this.take.told - 1, this.player.shown + width);
    const every = Math.max(1, Math.floor((last - first) / 60));
    for (const figure of this.figures) {
      if (!this.isOn(figure)) continue;
      const ways = this.player.chosen.map(() => [] as three.Vector3[]);
      for (let f = first; f <= last; f += every) {
        const pose = this.take.pose(f, figure.which);
        this.player.chosen.forEach((track, i) => {
          if (!Number.isNaN(pose[3 * track])) ways[i].push(new three.Vector3(pose[3 * track], pose[3 * track + 1], pose[3 * track + 2]));
        });
      }
      const material = new three.LineBasicMaterial({ color: colour(this.take.data.two ? figure.which : 'after') });
      for (const way of ways) {
        const line = new three.Line(new three.BufferGeometry().setFromPoints(way), material);
        line.userData = { figure };
        line.position.copy(figure.group.position);
        line.frustumCulled = false;
        this.trails.add(line);
      }
    }
  }

  /** Draws at the next screen refresh. */
  draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (this.ended) return;
      this.renderer.render(this.scene, this.camera);
      this.drawAxes();
    });
  }

  private drawAxes(): void {
    const turn = this.camera.quaternion.clone().invert();
    this.gizmo.replaceChildren();
    const named: [number, number][] = [];
    for (const [name, axis] of Object.entries(axes)) {
      const seen = axis.clone().applyQuaternion(turn);
      const add = (kind: string, attributes: Record<string, number | string>, text = ''): void => {
        const part = document.createElementNS('http://www.w3.org/2000/svg', kind);
        for (const [key, value] of Object.entries(attributes)) part.setAttribute(key, String(value));
        part.textContent = text;
        this.gizmo.append(part);
      };
      add('line', { x1: 0, y1: 0, x2: 17 * seen.x, y2: -17 * seen.y });
      const [x, y] = [23 * seen.x, -23 * seen.y];
      // The name is omitted if it would cover the centre or another name.
      if (Math.hypot(seen.x, seen.y) < 0.15 || named.some((at) => Math.hypot(at[0] - x, at[1] - y) < 10)) continue;
      named.push([x, y]);
      add('text', { x, y }, name.toUpperCase());
    }
  }

  /** Position and target of the camera, and the centre that it follows, for the next body. */
  viewpoint(): three.Vector3[] {
    return [this.camera.position.clone(), this.controls.target.clone(), this.centre.clone()];
  }
  seeFrom([position, target, centre]: three.Vector3[]): void {
    const way = this.centre.clone().sub(centre);
    this.camera.position.copy(position).add(way);
    this.controls.target.copy(target).add(way);
    this.controls.update();
    this.place();
    this.draw();
  }

  /** Call it before another body takes its place. */
  dispose(): void {
    this.ended = true;
    this.controls.dispose();
    this.scene.traverse((part) => {
      const { geometry, material } = part as Partial<three.Mesh>;
      geometry?.dispose();
      for (const one of [material ?? []].flat()) one.dispose();
    });
  }

  /** The position of a point of a body in the picture, -1 to 1; for tests. */
  seen(point: number, figure = this.main): [number, number] | null {
    const place = figure.at(point)?.add(figure.group.position) ?? null;
    if (place === null) return null;
    this.camera.updateMatrixWorld();
    const at = place.project(this.camera);
    return [at.x, at.y];
  }
}
