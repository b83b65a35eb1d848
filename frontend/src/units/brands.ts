/** Numbers that know their unit: mixing them up is a type error. Conversions live here and nowhere else. */

declare const unit: unique symbol;
type Brand<Unit extends string> = number & { readonly [unit]: Unit };

export type Metres = Brand<"m">;
export type Seconds = Brand<"s">;
export type MetresPerSecond = Brand<"m/s">;
export type KilometresPerHour = Brand<"km/h">;
export type Newtons = Brand<"N">;
export type NewtonsPerMetre = Brand<"N/m">;

export const metres = (value: number) => value as Metres;
export const seconds = (value: number) => value as Seconds;
export const metresPerSecond = (value: number) => value as MetresPerSecond;
export const newtons = (value: number) => value as Newtons;
export const newtonsPerMetre = (value: number) => value as NewtonsPerMetre;

export const toKmh = (speed: MetresPerSecond) => (speed * 3.6) as KilometresPerHour;

/** Static compression or stretch of a linear spring under a force. */
export const springTravel = (force: Newtons, stiffness: NewtonsPerMetre) => (force / stiffness) as Metres;
