/**
 * Pliant in JavaScript: scenes of cloth, ropes and soft bodies, simulated by Projective Dynamics.
 *
 *     import { loadPliant } from 'pliant';
 *     const pliant = await loadPliant();
 *     const scene = pliant.openScene(pliant.builtinScene('towel'), 'towel', '');
 *     for (let i = 0; i < 60; ++i) scene.step();
 *     console.log(scene.frame().positions);
 *     scene.delete();
 *
 * Lengths are in m, times in s, z is up. Members throw an `Error` with one line that says what is wrong, where, and
 * what to do; the scene is as it was then. Arrays are copies.
 */

export type Vec3 = [number, number, number];

/** Where the camera stands [m]; the angle in degrees, from the lower edge of the picture to the upper. */
export interface Viewpoint {
  eye: Vec3;
  target: Vec3;
  up: Vec3;
  fieldOfView: number;
}

/** The surface of a collider in its own frame: three corners for each triangle [m]. */
export interface ColliderLook {
  number: number;
  positions: Float32Array;
  normals: Float32Array;
  /** z = 0 in its frame, without end; it has no corners then. */
  isPlane: boolean;
  /** Whether it has an end, so that it can be moved. */
  isMovable: boolean;
}

/**
 * What is drawn of a scene, made once. Corners are the vertices of all bodies in their order, and behind them copies of
 * those at hard edges, which differ in their normals alone.
 */
export interface SceneLook {
  vertexCount: number;
  /** The vertex of each copy: corner `vertexCount + i` is where vertex `copies[i]` is. */
  copies: Uint32Array;
  /** Three corners each. */
  triangles: Uint32Array;
  /** Edges that belong to no triangle, two vertices each. */
  ropes: Uint32Array;
  /** Edges of the triangles for a wireframe, two vertices each. */
  edges: Uint32Array;
  /** Of each corner, four bytes: red, green, blue (sRGB), and 255 where it is of a sheet, 0 of a solid. */
  front: Uint8Array;
  /** Of each corner: red, green, blue of the other side, and the pattern: 0 none, 1 checker, 2 stripes. */
  back: Uint8Array;
  /** Of each corner: red, green, blue of every second field or stripe, and 0. */
  second: Uint8Array;
  /** Of each corner, three numbers: its place in the pattern, in fields; stripes go by the first. */
  places: Float32Array;
  /** Those that there are now. */
  colliders: ColliderLook[];
  viewpoint: Viewpoint;
  /** Direction that the light comes from. */
  light: Vec3;
  /** Behind everything, red, green and blue from 0 to 1 (sRGB). */
  background: Vec3;
  /** Height of the floor that is drawn [m]; null: none. */
  ground: number | null;
  /** Half the length of the diagonal of the box around everything [m]. */
  radius: number;
}

/** Everything that changes from picture to picture. */
export interface Frame {
  /** Of each corner [m]. */
  positions: Float32Array;
  /** Of each corner, of length 1; 0 where there are no triangles. */
  normals: Float32Array;
  /** Of each collider: position [m] and quaternion x, y, z, w. */
  poses: Float32Array;
  /** The numbers of these colliders; others than the look's where an event has added or removed one. */
  colliders: number[];
  /** Pinned vertices that can be grabbed, ascending. */
  pins: Uint32Array;
  /** Height of the floor, which gives way to what falls [m]. */
  ground: number;
  /** Where the scene's camera is now; null: it stands where the look has it. */
  viewpoint: Viewpoint | null;
  /** The point that is pulled at and the end of the spring [m]; null: nothing is pulled at. */
  pull: { from: Vec3; to: Vec3 } | null;
  /** Of each corner, what was asked to be shown as color; the ends of its color map. */
  values: { numbers: Float32Array; low: number; high: number } | null;
}

/** What colors can show: `stretch`, `energy`, `speed`, `gap`, `contact_force`. */
export interface ColorMap {
  name: string;
  /** With the unit. */
  title: string;
  /** What values are multiplied by for that unit. */
  scale: number;
  /** From the lowest value to the highest: red, green and blue of each (sRGB). */
  tones: Uint8Array;
}

/** A number, choice, vector or flag among the options of the solver, a constraint, a force, a collider or contact. */
export interface Parameter {
  /** Which one it is, from restart to restart. It is compared, never taken apart. */
  key: string;
  /** Of its constraint, force, collider or body; empty: of the solver. */
  heading: string;
  option: string;
  unit: string;
  doc: string;
  kind: 'real' | 'integer' | 'choice' | 'vector' | 'flag';
  /** Of each number; may be infinite. */
  min: number;
  max: number;
  /** One number, or three of a vector; of a choice the index, of a flag 0 or 1. */
  value: number[];
  choices: string[];
}

export interface BodyMaterial {
  body: string;
  /** Empty: it has constraints of its own. */
  material: string;
  choices: { name: string; description: string }[];
}

export interface Scene {
  /** For a picture of this width over height. Must be asked for anew when `rebuilds` has changed, or after a restart. */
  look(aspect: number): SceneLook;
  /** Of now, with the corners of the last look. color: with the values of that color map; `none` is the default. */
  frame(color?: string): Frame;
  name(): string;
  description(): string;
  /** On the last step or change; empty for none. */
  note(): string;
  warnings(): string[];
  /** How often undo, redo and the like made the scene anew. */
  rebuilds(): number;

  /** Simulated [s]. */
  time(): number;
  timeStep(): number;
  step(): void;
  /** Starts over; keeps: with what was changed. */
  restart(keeps: boolean): void;

  /** Pulls a point of a body, three vertices and the weight of each, to a place [m]. Stiffness [N/m]; 0: by the weight. */
  grab(vertices: ArrayLike<number>, weights: ArrayLike<number>, x: number, y: number, z: number, stiffness: number): void;
  /** Moves the end of that spring; does nothing without one, as does the next. */
  pullTo(x: number, y: number, z: number): void;
  letGo(): void;
  /** Holds a vertex where it is. */
  pin(vertex: number): void;
  unpin(vertex: number): void;
  movePin(vertex: number, x: number, y: number, z: number): void;
  /** The pin that was moved has been let go: before the first step that is a change of the scene. */
  dropPin(vertex: number): void;
  moveCollider(number: number, x: number, y: number, z: number): void;
  dropCollider(number: number): void;

  parameters(): Parameter[];
  /** x: the number, or the first of three. goesOn: with the change before it this is one for undo. */
  set(key: string, x: number, y: number, z: number, goesOn: boolean): void;
  materials(): BodyMaterial[];
  setMaterial(body: string, material: string): void;
  /** Take back the last change, and do it again; what moves stays where it is. */
  undo(): void;
  redo(): void;
  /** What they would take back and do again; empty: nothing. */
  undoneNext(): string;
  redoneNext(): string;
  hasChanges(): boolean;
  /** The scene with all changes as the text of a scene file. */
  text(): string;

  /** Frees its memory. */
  delete(): void;
}

export interface Pliant {
  version(): string;
  builtinScenes(): { name: string; description: string }[];
  colorMaps(): ColorMap[];
  /** The text of one of them. */
  builtinScene(name: string): string;
  /** Of the text of a scene file. name: what messages call it. Files that it names are looked for in `folder`. */
  openScene(text: string, name: string, folder: string): Scene;
  /** Of the file of a mesh, as what it most likely is. scale: meters per unit, 1: by its size; up: its axis. */
  openMesh(file: string, scale: number, up: 'x' | 'y' | 'z'): Scene;
  /** Puts a file where openScene and openMesh find it: in memory. */
  writeFile(path: string, bytes: Uint8Array): void;
  /** Removes a folder of such files. Scenes that were opened with them cannot restart, be undone or written then. */
  removeFiles(folder: string): void;
}

export interface LoadOptions {
  /** What pliant.wasm holds; without it the file beside the module is read. */
  wasmBinary?: ArrayBuffer | Uint8Array;
}

export function loadPliant(options?: LoadOptions): Promise<Pliant>;
