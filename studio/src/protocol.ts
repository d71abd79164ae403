/** What engines answer, as docs/studio-protocol.md has it. Numbers that are not finite arrive as null. */

export type Vec3 = [number, number, number];
export type Maybe = number | null;

export interface Hello {
  engine: string;
  version: string;
  protocol: number;
  threads: number;
}

export interface ModelParameter {
  name: string;
  value: Maybe;
  low: Maybe;
  high: Maybe;
  meaning: string;
}

export interface CatalogModel {
  name: string;
  title: string;
  summary: string;
  variants: { name: string; summary: string }[];
  species: string[];
  parameters: ModelParameter[];
}

export interface Ramp {
  name: string;
  colors: Vec3[];
}

export interface Catalog {
  recipes: { name: string; summary: string; shape: string }[];
  models: CatalogModel[];
  ramps: Ramp[];
  shapes: { name: string }[];
  reads: string[];
  writes: string[];
}

export interface ShapeInfo {
  name: string;
  vertices: number;
  triangles: number;
  low: Vec3;
  high: Vec3;
  diagonal: number;
  metres_per_unit: Maybe;
  up: "y" | "z";
  attributes: string[];
  findings: { kind: string; message: string; repaired: boolean }[];
}

export interface SpeciesRange {
  species: string;
  low: Maybe;
  high: Maybe;
}

/** The state of a growth, in the replies of `advance`, `begin` and `restore_state`. */
export interface Progress {
  running: boolean;
  status: string;
  message: string;
  stage: number;
  time: Maybe;
  steps: number;
  change: Maybe;
  fraction: Maybe;
  uniform: boolean;
  why_uniform: string;
  range: SpeciesRange[];
}

export interface Stage {
  name: string;
  model: string;
  size: Maybe;
  species: string[];
  parameters: ModelParameter[];
  /** Whether its diffusion follows directions. */
  anisotropic: boolean;
}

export interface Begun extends Progress {
  stages: Stage[];
  nodes: number;
  warnings: string[];
  node_spacing: Maybe;
  kept: boolean;
  recipe?: string;
}

export interface Analysis {
  title: string;
  verdict: string;
  wavelength: Maybe;
  spacing: Maybe;
  conditions: { text: string; holds: boolean }[];
  thresholds: string | string[];
  wavelengths: Maybe[];
  growth_rates: Maybe[];
}

export interface Exported {
  losses?: string[];
}

export interface MapAxis {
  parameter: string;
  low: number;
  high: number;
  count: number;
}

export interface ParameterMap {
  regimes: string[];
}

export interface MapTile {
  outcome: "pattern" | "uniform" | "failed";
  message?: string;
  side: Maybe;
}
