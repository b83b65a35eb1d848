/** A set of weights: a row a stage, the paper's in small beside each that differs. */

import type { Weights } from "../api/types";
import { dotted } from "../sweep/fields";
import { formatValue, singlesIn, weightAt, type Single, type Tunable } from "./space";
import ui from "../ui/ui.module.css";
import results from "./results.module.css";

interface Props {
  readonly weights: Weights;
  /** The paper's. */
  readonly beside: Weights | undefined;
  readonly tunable: Tunable;
}

export function WeightsOf({ weights, beside, tunable }: Props) {
  const { triples } = tunable;
  return (
    <table className={`${ui.table} ${results.weights}`}>
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
              <Weight key={item.pointer} name={dotted(item.pointer)} field={item} {...{ weights, beside }} />
            ))}
          </tr>
        ))}
        {singlesIn(tunable, weights).map(({ name, title, field }) => (
          <tr key={name}>
            <th scope="row">{title}</th>
            <Weight {...{ name, field }} {...{ weights, beside }} />
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Weight({ name, field, weights, beside }: Pick<Single, "name" | "field"> & Pick<Props, "weights" | "beside">) {
  const [value, paper] = [weightAt(weights, name), beside && weightAt(beside, name)];
  return (
    <td data-weight={name} data-value={value ?? ""}>
      {value === undefined ? "–" : formatValue(value, field)}
      {paper !== undefined && paper !== value && <span className={results.was}>{formatValue(paper, field)}</span>}
    </td>
  );
}
