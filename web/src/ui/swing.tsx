// A bar to the left or right of a middle line; `share` of half of the width, −1 to 1.
export const Swing = ({ share, isGood }: { share: number; isGood: boolean }) => (
  <span class="swing-track">
    <i
      class={isGood ? 'good' : 'poor'}
      style={{
        width: `${Math.min(1, Math.abs(share)) * 50}%`,
        left: share > 0 ? '50%' : `${50 - Math.min(1, Math.abs(share)) * 50}%`,
      }}
    />
  </span>
);
