// Printed by holdfast from the equations of its kernels: do not edit.
export const joints=JOINT_COUNT,axes=AXIS_COUNT,laws=LAW_COUNT,markers=MARKER_COUNT;
PROGRAMS
const steps=[STEP_FUNCTIONS];
const x=new Float64Array(2*joints+axes),y=new Float64Array(joints+axes);
export function cycle(law,q,velocity,healthy,out){
const step=steps[law];
if(step===undefined)throw new RangeError("law "+law+" is not known; the arm has "+laws+", from 0");
for(let i=0;i<joints;i++){x[i]=q[i];x[joints+axes+i]=healthy[i];}
for(let i=0;i<axes;i++)x[joints+i]=velocity[i];
step(x,y);
for(let i=0;i<axes;i++)out[joints+i]=y[joints+i];
for(let k=1;k<SUBSTEPS;k++){
for(let i=0;i<joints;i++)x[i]=y[i];
step(x,y);
}
for(let i=0;i<joints;i++)out[i]=y[i];
}
export function position(q,out){place(q,out);}
export function points(q,out){wire(q,out);}
// Engines compile what has run a while, from all sides: so that no trial has to wait for it.
const q0=new Float64Array(joints),v0=new Float64Array(axes);
const all=new Float64Array(joints).fill(1),end=new Float64Array(joints+axes);
for(let law=0;law<laws;law++)for(let k=0;k<WARMUP_CYCLES;k++){
for(let i=0;i<joints;i++)q0[i]=3*Math.sin(k*(i+1.3));
for(let i=0;i<axes;i++)v0[i]=k%7===0?0:0.05*Math.sin(k*(i+2.7));
cycle(law,q0,v0,all,end);
}
