// What the page and the worker that simulates say to each other. Arrays are transferred, not copied.
import type { BodyMaterial, ColorMap, Frame, Parameter, SceneLook } from '../npm/index';

export type {
  BodyMaterial, ColliderLook, ColorMap, Frame, Parameter, SceneLook, Vec3, Viewpoint,
} from '../npm/index';

/** A point of a body: three vertices, and the weight of each. */
export interface SurfacePoint {
  vertices: [number, number, number];
  weights: [number, number, number];
}

export interface NamedFile {
  name: string;
  bytes: Uint8Array;
}

export type UpAxis = 'x' | 'y' | 'z';

/** What a scene is opened from. Files are put beside the text, which may name them. */
export type SceneSource =
  | { kind: 'builtin'; name: string }
  | { kind: 'text'; text: string; name: string; files: NamedFile[] }
  | { kind: 'mesh'; name: string; files: NamedFile[]; up: UpAxis };

/** What the page asks of the worker. */
export type Command =
  | { type: 'open'; id: number; source: SceneSource; aspect: number }
  | { type: 'play'; on: boolean }
  | { type: 'step' }
  | { type: 'restart'; keeps: boolean }
  | { type: 'grab'; point: SurfacePoint; to: [number, number, number] }
  | { type: 'pullTo'; to: [number, number, number] }
  | { type: 'letGo' }
  | { type: 'pin'; vertex: number }
  | { type: 'unpin'; vertex: number }
  | { type: 'movePin'; vertex: number; to: [number, number, number] }
  | { type: 'dropPin'; vertex: number }
  | { type: 'moveCollider'; number: number; to: [number, number, number] }
  | { type: 'dropCollider'; number: number }
  | { type: 'set'; key: string; value: number[]; goesOn: boolean }
  | { type: 'setMaterial'; body: string; material: string }
  | { type: 'undo' }
  | { type: 'redo' }
  | { type: 'text'; id: number }
  /** What colors show: the name of a color map, or `none`. */
  | { type: 'color'; name: string }
  /** The frame that was sent last has been drawn: another one may come. */
  | { type: 'drawn' };

/** scene: the number of the `open` whose scene the page shows; what is meant for another one is dropped. */
export interface Letter {
  command: Command;
  scene: number;
}

export interface SceneEntry {
  name: string;
  description: string;
}

export interface Statistics {
  /** Simulated [s]. */
  time: number;
  /** Computing time of a step, mean over the last half second [ms]. */
  stepMilliseconds: number;
  stepsPerSecond: number;
  /** Simulated seconds per second; 0 while nothing moves. */
  speed: number;
  isPlaying: boolean;
}

export interface PanelState {
  parameters: Parameter[];
  materials: BodyMaterial[];
  undoneNext: string;
  redoneNext: string;
  hasChanges: boolean;
}

/** What the worker reports. */
export type Report =
  | { type: 'ready'; scenes: SceneEntry[]; colors: ColorMap[] }
  | { type: 'opened'; id: number; name: string; description: string; look: SceneLook; panel: PanelState; warnings: string[] }
  /** The bodies or colliders are others than before, of the same scene. */
  | { type: 'look'; look: SceneLook }
  | { type: 'frame'; frame: Frame; statistics: Statistics }
  | { type: 'panel'; panel: PanelState }
  | { type: 'note'; text: string }
  | { type: 'text'; id: number; text: string }
  /** What a command could not do; of `open`: the scene before goes on. */
  | { type: 'error'; message: string; command: Command['type'] | 'load'; id?: number };
