/** A picture that the service has made. Where it asks for a key, an address alone gets none: it is fetched with it. */

import { useEffect, useState } from "preact/hooks";

import { key } from "../service/key";
import { LostError, ProblemError } from "../service/problem";
import { file, relative } from "../service/service";
import { returns } from "../state/connection";

interface ServicePictureProps {
  readonly link: string;
  /** The picture is there, or will not come. */
  readonly onSettled: () => void;
}

export function ServicePicture({ link, onSettled }: ServicePictureProps) {
  const [failedAt, setFailedAt] = useState<number>();
  const asked = returns.value;
  const fetched = useFetched(key.value ? link : undefined);
  const address = key.value ? fetched : relative(link);
  const fail = () => {
    setFailedAt(asked);
    onSettled();
  };
  // One that has failed leaves its place empty, and is asked for anew when the service comes back.
  if (!address || failedAt === asked) return null;
  return <img src={address} alt="" loading="lazy" decoding="async" onLoad={onSettled} onError={fail} />;
}

function useFetched(link: string | undefined): string | undefined {
  const [address, setAddress] = useState<string>();
  useEffect(() => {
    if (link === undefined) return;
    const stopped = new AbortController();
    let made = "";
    file(link, stopped.signal)
      .then((bytes) => setAddress((made = URL.createObjectURL(new Blob([bytes], { type: "image/png" })))))
      .catch((error: unknown) => ignored(error, stopped.signal));
    return () => {
      stopped.abort();
      URL.revokeObjectURL(made);
    };
  }, [link]);
  return address;
}

/** The place of the picture stays empty. */
function ignored(error: unknown, { aborted }: AbortSignal): void {
  if (aborted || error instanceof ProblemError || error instanceof LostError) return;
  throw error;
}
