/** A set of weights: a row a stage, the paper's in small beside each that differs. */

import type { Weights } from "../api/types";
import { dotted } from "../sweep/fields";
import { formatInput } from "../units/format";
import { weightAt, type Tunable } from "./space";
import results from "./results.module.css";

interface Props {
  readonly weights: Weights;
  /** The paper's. */
  readonly beside: Weights | undefined;
  readonly tunable: Tunable;
}

export function WeightsOf({ weights, beside, tunable: { triples, travel } }: Props) {
  const travelName = travel ? dotted(travel.pointer) : "";
  const withTravel = travel !== null && weightAt(weights, travelName) !== undefined;
  return (
    <table className={results.weights}>
      <caption className="visually-hidden">Weights</caption>
      <thead>
        <tr>
          <td />
          {triples[0]?.items.map(({ title }) => (
            <th key={title} scope="col">
              {title}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {triples.map(({ pointer, title, items }) => (
          <tr key={pointer}>
            <th scope="row">{title}</th>
            {items.map((item) => (
              <Weight key={item.pointer} name={dotted(item.pointer)} {...{ weights, beside }} />
            ))}
          </tr>
        ))}
        {withTravel && (
          <tr>
            <th scope="row">{travel.title}</th>
            <Weight name={travelName} {...{ weights, beside }} />
          </tr>
        )}
      </tbody>
    </table>
  );
}

function Weight({ name, weights, beside }: { readonly name: string } & Pick<Props, "weights" | "beside">) {
  const [value, paper] = [weightAt(weights, name), beside && weightAt(beside, name)];
  return (
    <td data-weight={name} data-value={value ?? ""}>
      {value === undefined ? "–" : formatInput(value)}
      {paper !== undefined && paper !== value && <span className={results.was}>{formatInput(paper)}</span>}
    </td>
  );
}
