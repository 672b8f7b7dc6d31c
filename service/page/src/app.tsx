/** The page: what is where. */

import { spec } from "./state/editor";

export function App() {
  return <h1>{spec.value.name}</h1>;
}
