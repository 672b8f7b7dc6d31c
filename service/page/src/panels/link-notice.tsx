/** What is wrong with the link that was followed. */

import { linkMessage } from "../state/permalink";
import "./link-notice.css";

export function LinkNotice() {
  return (
    <div role="alert">
      {linkMessage.value && (
        <p class="link-notice">
          <span>{linkMessage.value}</span>
          <button type="button" onClick={() => (linkMessage.value = "")}>
            Close
          </button>
        </p>
      )}
    </div>
  );
}
